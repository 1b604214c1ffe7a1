// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/observe.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "tests/unit/refine_lines/made_points.h"

namespace roomcut::refine_lines {
using namespace roomcut::testing;

namespace {

using testing::add_point;
using testing::add_wall;
using testing::Normal;
using testing::whole_line;

const std::vector<double> kLevels{0, 2.5};

TEST(LineObserver, TheTwoFacesOfAThinWallDoNotMix) {
  const Line2 near{std::numbers::pi / 2, 0.0};
  const Line2 far{std::numbers::pi / 2, 0.06};
  const std::vector<LineFaces> lines{whole_line(near, -4, 0, -1), whole_line(far, -4, 0, 1)};
  Normal random(3);
  CloudTile tile;
  add_wall(tile, random, near, -4, 0, 500, 0.005);
  add_wall(tile, random, far, -4, 0, 500, 0.005);
  LineObserver observer(lines, {true, true}, kLevels, 0.06, 0.005, 500);
  observer.add(tile);
  EXPECT_EQ(observer.points(), tile.size());
  for (std::size_t i = 0; i < 2; ++i) {
    const auto found = observer.observations(i);
    ASSERT_EQ(found.size(), 200U);  // 40 bins in 5 zones
    for (const Observation& o : found) {
      EXPECT_NEAR(lines[i].line.distance(o.point), 0, 0.006);
    }
  }
}

TEST(LineObserver, AThinWallWhoseInnerPointsHaveNoPlaneIsNotPushedApart) {
  const Line2 line{0, 2.0};
  const std::vector<LineFaces> lines{whole_line(line, 0, 4)};
  Normal random(6);
  CloudTile tile;
  add_wall(tile, random, line, 0, 4, 500, 0.005);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    if (tile.x[i] < 2.0F) {
      tile.surface[i] = static_cast<std::uint8_t>(SurfaceClass::kNone);
      tile.azimuth[i] = 0;
    }
  }
  LineObserver observer(lines, {true}, kLevels, 0.06, 0.005, 500);
  observer.add(tile);
  double sum = 0;
  const auto found = observer.observations(0);
  for (const Observation& o : found) {
    sum += line.distance(o.point);
  }
  EXPECT_NEAR(sum / static_cast<double>(found.size()), 0, 0.0003);
}

TEST(LineObserver, PointsWithoutAPlaneBesideFloorOrCeilingAreTheirEdges) {
  const Line2 line{0, 2.0};
  const std::vector<LineFaces> lines{whole_line(line, 0, 4)};
  CloudTile tile;
  for (const double z : {0.05, 1.0, 2.45}) {
    add_point(tile, line.at(1.0), z, 0);
    tile.surface.back() = static_cast<std::uint8_t>(SurfaceClass::kNone);
  }
  LineObserver observer(lines, {true}, kLevels, 0.06, 0.005, 500);
  observer.add(tile);
  EXPECT_EQ(observer.points(), 1U);
}

TEST(LineObserver, APointWithAnotherAzimuthHeightOrPlaceIsNotTaken) {
  const Line2 line{0, 1.0};
  LineFaces faces = whole_line(line, 0, 4);
  faces.side[5] = 0;  // 0.5 … 0.6 m: no surface here
  const std::vector<LineFaces> lines{faces};
  LineObserver observer(lines, {true}, kLevels, 0.06, 0.005, 500);
  CloudTile tile;
  add_point(tile, line.at(1.0), 1, 18 * testing::kDeg);
  add_point(tile, line.at(1.0), 2.6, 0);
  add_point(tile, line.at(1.0), -0.1, 0);
  add_point(tile, line.at(0.55), 1, 0);
  add_point(tile, line.at(4.1), 1, 0);
  add_point(tile, line.at(1.0) + 0.07 * line.normal(), 1, 0);
  observer.add(tile);
  EXPECT_EQ(observer.points(), 0U);
  CloudTile good;
  add_point(good, line.at(1.0), 1, 16 * testing::kDeg);
  add_point(good, line.at(1.0), 1, -16 * testing::kDeg);
  observer.add(good);
  EXPECT_EQ(observer.points(), 2U);
}

TEST(LineObserver, OrderAndThreadsDoNotMatter) {
  const Line2 line = normalised(0.7, 3.0);
  const std::vector<LineFaces> lines{whole_line(line, -3, 5)};
  std::vector<CloudTile> tiles(16);
  Normal random(4);
  for (CloudTile& tile : tiles) {
    add_wall(tile, random, line, -3, 5, 30, 0.006);
  }
  LineObserver serial(lines, {true}, kLevels, 0.06, 0.006, 500);
  for (const CloudTile& tile : tiles) {
    serial.add(tile);
  }
  LineObserver parallel(lines, {true}, kLevels, 0.06, 0.006, 500);
  tbb::parallel_for(std::size_t{0}, tiles.size(),
                    [&](std::size_t i) { parallel.add(tiles[tiles.size() - 1 - i]); });
  const auto a = serial.observations(0);
  const auto b = parallel.observations(0);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), 400U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].point, b[i].point);
    EXPECT_EQ(a[i].variance_m2, b[i].variance_m2);
  }
}

TEST(LineObserver, AnInactiveLineTakesNoPoints) {
  const Line2 line{0, 1.0};
  const std::vector<LineFaces> lines{whole_line(line, 0, 4), whole_line({0, 1.005}, 0, 4)};
  LineObserver observer(lines, {true, false}, kLevels, 0.06, 0.005, 500);
  Normal random(5);
  CloudTile tile;
  add_wall(tile, random, {0, 1.005}, 0, 4, 200, 0.003);
  observer.add(tile);
  EXPECT_TRUE(observer.observations(1).empty());
  EXPECT_GT(observer.observations(0).size(), 180U);
}

}  // namespace
}  // namespace roomcut::refine_lines

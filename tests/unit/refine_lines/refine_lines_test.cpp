// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/refine_lines.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/errors/codes.h"
#include "common/errors/error.h"
#include "tests/unit/refine_lines/grid_building.h"
#include "tests/unit/refine_lines/made_points.h"

namespace roomcut::refine_lines {
namespace {

using testing::add_wall;
using testing::grid_complex;
using testing::Normal;

/// Two rooms beside each other, a wall of 6 cm between them. The lines lie up to 12 mm off the true walls.
class RefineLines : public ::testing::Test {
 protected:
  RefineLines() {
    label_ = testing::labelled(complex_, [](const Vec2& p, std::size_t) {
      return p.y() > 0 && p.y() < 4 && p.x() > 0 && p.x() < 9 && !(p.x() > 5 && p.x() < 5.06);
    });
    for (const CellComplex::Line& line : complex_.lines) {
      WallLine wall;
      wall.id = line.wall_id;
      const bool upright = line.wall_id.front() == 'x';
      wall.a = upright ? Vec2(line.line.d, 0) : Vec2(0, line.line.d);
      wall.b = upright ? Vec2(line.line.d, 4) : Vec2(9, line.line.d);
      wall.support_m = wall.length();
      lines_.lines.push_back(wall);
    }
    Normal random(31);
    constexpr double kRight = std::numbers::pi / 2;
    add_wall(points_, random, {0, kWest}, 0, 4, 300, kNoise);
    add_wall(points_, random, {0, kNear}, 0, 4, 300, kNoise);
    add_wall(points_, random, {0, kFar}, 0, 4, 300, kNoise);
    add_wall(points_, random, {0, kEast}, 0, 4, 300, kNoise);
    add_wall(points_, random, {kRight, kSouth}, -9, 0, 300, kNoise);
    add_wall(points_, random, {kRight, kNorth}, -9, 0, 300, kNoise);
  }

  Refinement refine() {
    LineRefiner refiner(lines_, complex_, label_, kNoise, 300, params_);
    refiner.add(points_);
    return refiner.finish();
  }
  WallLine& wall(const std::string& id) { return const_cast<WallLine&>(find(lines_, id)); }
  static const WallLine& find(const WallLines& lines, const std::string& id) {
    return *std::find_if(lines.lines.begin(), lines.lines.end(),
                         [&](const WallLine& line) { return line.id == id; });
  }
  static bool has(const WallLines& lines, const std::string& id) {
    return std::any_of(lines.lines.begin(), lines.lines.end(),
                       [&](const WallLine& line) { return line.id == id; });
  }

  static constexpr double kNoise = 0.004;
  static constexpr double kWest = 0.008, kNear = 4.995, kFar = 5.065, kEast = 9.012, kSouth = -0.006,
                          kNorth = 4.004;
  CellComplex complex_ = grid_complex({-2, 0, 5, 5.06, 9, 11}, {-2, 0, 4, 6}, {0, 2.5});
  std::vector<std::uint8_t> label_;
  WallLines lines_;
  CloudTile points_;
  RefineLinesParams params_;
};

TEST_F(RefineLines, EveryWallIsFoundToATenthOfAMillimetrePerSigma) {
  const Refinement found = refine();
  ASSERT_EQ(found.lines.lines.size(), 6U);
  const double truth[6] = {kWest, kNear, kFar, kEast, kSouth, kNorth};
  const char* ids[6] = {"x1", "x2", "x3", "x4", "y1", "y2"};
  for (int i = 0; i < 6; ++i) {
    const WallLine& line = find(found.lines, ids[i]);
    const double at = ids[i][0] == 'x' ? line.centre().x() : line.centre().y();
    EXPECT_NEAR(at, truth[i], 3.5 * line.sigma_offset_m) << ids[i];
    EXPECT_LT(line.sigma_offset_m, 0.0004) << ids[i];
    EXPECT_GT(line.sigma_offset_m, 0.00003) << ids[i];
    EXPECT_EQ(line.source, LineSource::kRefined);
    EXPECT_NEAR(line.rms_m, kNoise, 0.0008) << ids[i];
    EXPECT_GT(line.support_m, 0.9 * line.length()) << ids[i];
  }
  EXPECT_EQ(found.classes, 1);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.largest_shift_m, 0.012, 0.001);
}

TEST_F(RefineLines, TheThinWallKeepsBothFaces) {
  const Refinement found = refine();
  EXPECT_EQ(found.merged, 0);
  EXPECT_NEAR(find(found.lines, "x3").centre().x() - find(found.lines, "x2").centre().x(), kFar - kNear,
              0.001);
}

TEST_F(RefineLines, TheEndsReachOverTheWholeSurface) {
  const WallLine south = find(refine().lines, "y1");
  EXPECT_NEAR(std::min(south.a.x(), south.b.x()), 0, 0.01);
  EXPECT_NEAR(std::max(south.a.x(), south.b.x()), 9, 0.01);
}

TEST_F(RefineLines, TheShortSidesOfANicheStayAndAFullLineWithAsLittleSurfaceGoes) {
  complex_ = grid_complex({-2, 0, 4, 4.4, 9, 11}, {-2, -0.06, 0, 4, 6}, {0, 2.5});
  label_ = testing::labelled(complex_, [](const Vec2& p, std::size_t) {
    return (p.x() > 0 && p.x() < 9 && p.y() > 0 && p.y() < 4) ||
           (p.x() > 4 && p.x() < 4.4 && p.y() > -0.06 && p.y() < 0);
  });
  const auto add = [&](const char* id, const Vec2& a, const Vec2& b) {
    WallLine line;
    line.id = id;
    line.a = a;
    line.b = b;
    lines_.lines.push_back(line);
  };
  lines_.lines.clear();
  add("x1", {0, 0}, {0, 4});
  add("x2", {4, -0.06}, {4, 0});
  add("x3", {4.4, -0.06}, {4.4, 4});
  add("x4", {9, 0}, {9, 4});
  add("y2", {0, 0}, {9, 0});
  add("y3", {0, 4}, {9, 4});
  const Refinement found = refine();
  EXPECT_TRUE(has(found.lines, "x2"));
  EXPECT_FALSE(has(found.lines, "x3"));
}

TEST_F(RefineLines, ALineWithoutSurfaceIsDroppedUnlessItIsTheUsers) {
  complex_ = grid_complex({-2, 0, 5, 5.06, 7, 9, 11}, {-2, 0, 4, 6}, {0, 2.5});
  label_ = testing::labelled(complex_, [](const Vec2& p, std::size_t) {
    return p.y() > 0 && p.y() < 4 && p.x() > 0 && p.x() < 9 && !(p.x() > 5 && p.x() < 5.06);
  });
  wall("x4").id = "x5";
  WallLine extra;
  extra.id = "x4";
  extra.a = {7, 0};
  extra.b = {7, 4};
  lines_.lines.push_back(extra);
  EXPECT_FALSE(has(refine().lines, "x4"));
  EXPECT_EQ(refine().dropped, 1);
  wall("x4").source = LineSource::kAdded;
  const Refinement found = refine();
  EXPECT_EQ(find(found.lines, "x4").a, Vec2(7, 0));
  EXPECT_EQ(find(found.lines, "x4").source, LineSource::kAdded);
  EXPECT_EQ(found.held, 1);
}

TEST_F(RefineLines, ALockedLineIsNotTouched) {
  wall("x1").locked = true;
  wall("x1").note = "measured by hand";
  const WallLine line = find(refine().lines, "x1");
  EXPECT_EQ(line.a, Vec2(0, 0));
  EXPECT_EQ(line.b, Vec2(0, 4));
  EXPECT_TRUE(line.locked);
  EXPECT_EQ(line.note, "measured by hand");
  EXPECT_EQ(line.source, LineSource::kDetected);
}

TEST_F(RefineLines, EditedLinesAreHeldWhenTheParameterSaysSo) {
  wall("x1").source = LineSource::kEdited;
  EXPECT_NEAR(find(refine().lines, "x1").centre().x(), kWest, 0.001);
  params_.edited_lines = "locked";
  EXPECT_EQ(find(refine().lines, "x1").centre().x(), 0);
}

TEST_F(RefineLines, ALineWithAWallSeenFromOneSideIsSplitLikeAnyOther) {
  // Three rows of rooms along one line; its northern wall lies 3 cm off, both sides of the middle one are
  // empty.
  complex_ = grid_complex({-2, 0, 5, 9, 11}, {-2, 0, 4, 4.4, 8, 8.4, 12, 14}, {0, 2.5});
  label_ = testing::labelled(complex_, [](const Vec2& p, std::size_t) {
    const bool wall = p.y() < 0 || p.y() > 12 || (p.y() > 4 && p.y() < 4.4) || (p.y() > 8 && p.y() < 8.4);
    return !wall && p.x() > 0 && p.x() < 9 && !(p.x() > 5 && (p.y() < 4 || p.y() > 8.4));
  });
  lines_.lines.clear();
  for (const CellComplex::Line& line : complex_.lines) {
    WallLine wall;
    wall.id = line.wall_id;
    wall.a = line.line.at(line.t0);
    wall.b = line.line.at(line.t1);
    lines_.lines.push_back(wall);
  }
  points_ = {};
  Normal random(5);
  add_wall(points_, random, {0, 5.0}, 0, 4, 300, kNoise);
  add_wall(points_, random, {0, 5.03}, 8.4, 12, 300, kNoise);
  const OneSidedWall middle{"x2", true, 5.2, 8, {0}, 7, {0, 5}};
  LineRefiner refiner(lines_, complex_, label_, kNoise, 300, params_, {middle});
  refiner.add(points_);
  const Refinement found = refiner.finish();
  EXPECT_EQ(found.split, 1);
  ASSERT_EQ(found.one_sided.size(), 1U);
  const WallLine& nearest = find(found.lines, found.one_sided[0].wall_id);
  EXPECT_NEAR(std::abs(nearest.line().distance({0, 10})), 5.03, 0.001);
  EXPECT_NEAR(std::min(nearest.a.y(), nearest.b.y()), -2, 0.001) << "as long as it was";
  const WallLine& other = find(found.lines, nearest.id == "x2" ? "x2.1" : "x2");
  EXPECT_NEAR(std::abs(other.line().distance({0, 2})), 5.0, 0.001);
}

TEST_F(RefineLines, TheOrderOfTheTilesDoesNotMatter) {
  CloudTile halves[2];
  for (std::size_t i = 0; i < points_.size(); ++i) {
    CloudTile& half = halves[i % 2];
    half.x.push_back(points_.x[i]);
    half.y.push_back(points_.y[i]);
    half.z.push_back(points_.z[i]);
    half.surface.push_back(points_.surface[i]);
    half.azimuth.push_back(points_.azimuth[i]);
    half.area.push_back(points_.area[i]);
  }
  LineRefiner refiner(lines_, complex_, label_, kNoise, 300, params_);
  refiner.add(halves[1]);
  refiner.add(halves[0]);
  const Refinement there = refiner.finish();
  const Refinement here = refine();
  for (std::size_t i = 0; i < here.lines.lines.size(); ++i) {
    EXPECT_EQ(there.lines.lines[i].a, here.lines.lines[i].a);
    EXPECT_EQ(there.lines.lines[i].b, here.lines.lines[i].b);
  }
}

TEST_F(RefineLines, AModelWithoutAnyEmptyCellSaysWhatIsWrong) {
  std::fill(label_.begin(), label_.end(), 0);
  try {
    refine();
    FAIL();
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems()[0].code.id, errors::kNoWallLines.id);
  }
}

}  // namespace
}  // namespace roomcut::refine_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/jogs.h"

#include <gtest/gtest.h>

#include <set>

#include "stages/detect_lines/detect_lines.h"
#include "stages/slice/slice.h"
#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::detect_lines {
namespace {

using testing::SyntheticCloud;

constexpr double kHeight_m = 2.6;

std::vector<WallLine> lines_of(const SyntheticCloud& cloud) {
  return detect_lines(slice::slice_cloud(cloud.header(), cloud.source(), {}).slices, {}).lines.lines;
}

/// A room of 8 x 6 m whose wall at y = 0 jumps by `depth` to the outside from x0 to x1; `depth` < 0: inside.
void room_with_niche(SyntheticCloud& cloud, double x0, double x1, double depth) {
  cloud.horizontal({0, 0}, {8, 6}, 0.0);
  cloud.horizontal({0, 0}, {8, 6}, kHeight_m);
  cloud.wall({0, 0}, {x0, 0}, 0, kHeight_m);
  cloud.wall({x0, 0}, {x0, -depth}, 0, kHeight_m);
  cloud.wall({x0, -depth}, {x1, -depth}, 0, kHeight_m);
  cloud.wall({x1, -depth}, {x1, 0}, 0, kHeight_m);
  cloud.wall({x1, 0}, {8, 0}, 0, kHeight_m);
  cloud.wall({8, 0}, {8, 6}, 0, kHeight_m);
  cloud.wall({8, 6}, {0, 6}, 0, kHeight_m);
  cloud.wall({0, 6}, {0, 0}, 0, kHeight_m);
}

/// Whether a line passes within `off_m` of both points and covers the middle between them.
bool has_line(const std::vector<WallLine>& lines, const Vec2& a, const Vec2& b, double off_m) {
  return std::any_of(lines.begin(), lines.end(), [&](const WallLine& wall) {
    const Line2 line = wall.line();
    const double t = line.along(0.5 * (a + b));
    const auto [t0, t1] = std::minmax({line.along(wall.a), line.along(wall.b)});
    return std::abs(line.distance(a)) < off_m && std::abs(line.distance(b)) < off_m && t0 < t && t < t1;
  });
}

TEST(Jogs, BackAndRevealsOfNichesAndPilastersFromEightTimesTwentyFiveCentimetresAreLines) {
  struct Case {
    double depth, length, noise, density;
  };
  for (const Case& c :
       {Case{0.08, 0.25, 0.002, 1500}, Case{0.10, 0.5, 0.004, 500}, Case{0.3, 0.3, 0.005, 500},
        Case{-0.10, 0.4, 0.004, 500}, Case{-0.25, 0.3, 0.006, 500}}) {
    SyntheticCloud cloud(c.noise, c.density);
    room_with_niche(cloud, 3, 3 + c.length, c.depth);
    const std::vector<WallLine> found = lines_of(cloud);
    EXPECT_EQ(found.size(), 7U) << c.depth << " x " << c.length;
    EXPECT_TRUE(has_line(found, {3, -c.depth}, {3 + c.length, -c.depth}, 0.01))
        << c.depth << " x " << c.length;
    EXPECT_TRUE(has_line(found, {3, 0}, {3, -c.depth}, 0.02)) << c.depth << " x " << c.length;
    EXPECT_TRUE(has_line(found, {3 + c.length, 0}, {3 + c.length, -c.depth}, 0.02))
        << c.depth << " x " << c.length;
  }
}

/// A second room beside it whose floor lies 25 cm lower, so that the lowest slice holds nothing but its foot;
/// its wall at y = 6.2 was not seen from x = 5 to 5.45 m.
void lower_room(SyntheticCloud& cloud) {
  cloud.horizontal({0, 6.2}, {8, 10}, -0.25);
  cloud.horizontal({0, 6.2}, {8, 10}, kHeight_m);
  cloud.wall({0, 6.2}, {5, 6.2}, -0.25, kHeight_m);
  cloud.wall({5.45, 6.2}, {8, 6.2}, -0.25, kHeight_m);
  cloud.wall({8, 6.2}, {8, 10}, -0.25, kHeight_m);
  cloud.wall({8, 10}, {0, 10}, -0.25, kHeight_m);
  cloud.wall({0, 10}, {0, 6.2}, -0.25, kHeight_m);
}

TEST(Jogs, ACupboardOfWhichALowSliceShowsTheFootIsNone) {
  for (const double height : {2.0, kHeight_m + 0.25}) {  // a cupboard, and a pilaster up to the ceiling
    SyntheticCloud cloud(0.004, 800);
    room_with_niche(cloud, 3, 3.4, 0);
    lower_room(cloud);
    const double top = height - 0.25;
    cloud.wall({5, 6.2}, {5, 6.6}, -0.25, top);
    cloud.wall({5, 6.6}, {5.45, 6.6}, -0.25, top);
    cloud.wall({5.45, 6.6}, {5.45, 6.2}, -0.25, top);
    if (top < kHeight_m) cloud.wall({5, 6.2}, {5.45, 6.2}, top, kHeight_m);
    const std::vector<WallLine> found = lines_of(cloud);
    const bool pilaster = height > kHeight_m;
    EXPECT_EQ(has_line(found, {5, 6.2}, {5, 6.6}, 0.02), pilaster) << height;
    EXPECT_EQ(has_line(found, {5, 6.6}, {5.45, 6.6}, 0.02), pilaster) << height;
  }
}

TEST(Jogs, WithoutShortLinesThereIsNone) {
  SyntheticCloud cloud;
  room_with_niche(cloud, 3, 3.4, 0.15);
  DetectLinesParams params;
  params.short_lines = false;
  const Slices slices = slice::slice_cloud(cloud.header(), cloud.source(), {}).slices;
  EXPECT_EQ(detect_lines(slices, params).lines.lines.size(), 4U);
  EXPECT_EQ(detect_lines(slices, {}).lines.lines.size(), 7U);
}

TEST(Jogs, WhereAWallJumpsTheRevealIsALine) {
  SyntheticCloud cloud;
  cloud.horizontal({0, 0}, {8, 6}, 0.0);
  cloud.horizontal({0, 0}, {8, 6}, kHeight_m);
  cloud.wall({0, 0}, {4, 0}, 0, kHeight_m);
  cloud.wall({4, 0}, {4, -0.3}, 0, kHeight_m);
  cloud.wall({4, -0.3}, {8, -0.3}, 0, kHeight_m);
  cloud.wall({8, -0.3}, {8, 6}, 0, kHeight_m);
  cloud.wall({8, 6}, {0, 6}, 0, kHeight_m);
  cloud.wall({0, 6}, {0, 0}, 0, kHeight_m);
  EXPECT_TRUE(has_line(lines_of(cloud), {4, 0}, {4, -0.3}, 0.02));
}

TEST(Jogs, ClutterBesideAWallIsNone) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {8, 6}, 0, kHeight_m);
  cloud.wall({2, 0.15}, {2.35, 0.15}, 0, kHeight_m);  // open at both ends, the wall behind it seen
  cloud.wall({5, 0.2}, {5.4, 0.32}, 1.2, kHeight_m, SurfaceClass::kNone);
  EXPECT_EQ(lines_of(cloud).size(), 4U);
}

TEST(Jogs, TwoFacesOfOneWallSeenInTurnsHaveNoReveal) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {8, 4}, 0, kHeight_m);
  cloud.horizontal({0, 4.3}, {8, 8}, 0.0);
  cloud.horizontal({0, 4.3}, {8, 8}, kHeight_m);
  cloud.wall({4.05, 4.3}, {8, 4.3}, 0, kHeight_m);  // the rest of it was hidden
  cloud.wall({8, 4.3}, {8, 8}, 0, kHeight_m);
  cloud.wall({8, 8}, {0, 8}, 0, kHeight_m);
  cloud.wall({0, 8}, {0, 4.3}, 0, kHeight_m);
  for (const WallLine& line : lines_of(cloud)) EXPECT_GT(line.length(), 0.5);
}

TEST(Jogs, EqualNichesInARowShareTheLineOfTheirBacks) {
  SyntheticCloud cloud(0.004, 600);
  cloud.horizontal({0, 0}, {8, 6}, 0.0);
  cloud.horizontal({0, 0}, {8, 6}, kHeight_m);
  double x = 0;
  for (const double niche : {1.5, 3.5, 5.5}) {
    cloud.wall({x, 0}, {niche, 0}, 0, kHeight_m);
    cloud.wall({niche, 0}, {niche, -0.12}, 0, kHeight_m);
    cloud.wall({niche, -0.12}, {niche + 0.4, -0.12}, 0, kHeight_m);
    cloud.wall({niche + 0.4, -0.12}, {niche + 0.4, 0}, 0, kHeight_m);
    x = niche + 0.4;
  }
  cloud.wall({x, 0}, {8, 0}, 0, kHeight_m);
  cloud.wall({8, 0}, {8, 6}, 0, kHeight_m);
  cloud.wall({8, 6}, {0, 6}, 0, kHeight_m);
  cloud.wall({0, 6}, {0, 0}, 0, kHeight_m);
  std::set<double> offsets;
  for (const WallLine& line : lines_of(cloud)) {
    if (std::abs(line.centre().y() + 0.12) < 0.02) offsets.insert(std::round(1e6 * line.line().d));
  }
  EXPECT_EQ(offsets.size(), 1U);
}

}  // namespace
}  // namespace roomcut::detect_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "stages/detect_lines/detect_lines.h"
#include "stages/slice/slice.h"
#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::detect_lines {
namespace {

using testing::SyntheticCloud;

constexpr double kHeight_m = 2.7;
constexpr double kPi = std::numbers::pi;

DetectLinesResult lines_of(const SyntheticCloud& cloud) {
  return detect_lines(slice::slice_cloud(cloud.header(), cloud.source(), {}).slices, {});
}

/// Walls along a circle between two azimuths, in so many sides.
void polygon(SyntheticCloud& cloud, const Vec2& centre, double radius, double from, double to, int sides) {
  const auto corner = [&](int k) -> Vec2 {
    const double angle = from + (to - from) * k / sides;
    return centre + radius * Vec2(std::cos(angle), std::sin(angle));
  };
  for (int k = 0; k < sides; ++k) cloud.wall(corner(k), corner(k + 1), 0, kHeight_m);
}

void floor_and_ceiling(SyntheticCloud& cloud, const Vec2& low, const Vec2& high) {
  cloud.horizontal(low, high, 0);
  cloud.horizontal(low, high, kHeight_m);
}

std::vector<WallLine> chords(const DetectLinesResult& result) {
  std::vector<WallLine> found;
  for (const WallLine& line : result.lines.lines) {
    if (line.extra_json.find("arc_id") != std::string::npos) found.push_back(line);
  }
  return found;
}

TEST(Arcs, ARoundRoomIsAPolygonOfItsArea) {
  for (const double radius : {1.2, 2.5, 6.0}) {
    SyntheticCloud cloud(0.005, 400);
    cloud.room({-8, -8}, {8, 8}, 0, kHeight_m);
    polygon(cloud, {0.5, -0.3}, radius, 0, 2 * kPi, 720);
    const DetectLinesResult result = lines_of(cloud);
    const std::vector<WallLine> found = chords(result);
    EXPECT_EQ(result.arcs, 1U) << radius;
    EXPECT_EQ(result.lines.lines.size(), found.size() + 4) << radius;
    double area = 0;
    for (const WallLine& chord : found) {
      area += 0.5 * chord.length() * std::abs(chord.line().distance({0.5, -0.3}));
      EXPECT_LT(chord.length() * chord.length() / (8 * radius), 0.0055) << radius;  // its sagitta
    }
    EXPECT_NEAR(std::sqrt(area / kPi), radius, 0.002) << radius;
  }
}

TEST(Arcs, ABayHasBothOfItsFaces) {
  SyntheticCloud cloud(0.005, 400);
  floor_and_ceiling(cloud, {-6, -4}, {6, 0});
  cloud.wall({-6, 0}, {-2, 0}, 0, kHeight_m);
  polygon(cloud, {0, 0}, 2, kPi, 0, 200);
  cloud.wall({2, 0}, {6, 0}, 0, kHeight_m);
  polygon(cloud, {0, 0}, 2.2, kPi, 0, 200);
  EXPECT_EQ(lines_of(cloud).arcs, 2U);
}

TEST(Arcs, ARoundedCornerEndsWhereItsWallsBegin) {
  SyntheticCloud cloud(0.004, 600);
  floor_and_ceiling(cloud, {1, 1}, {5, 5});
  cloud.wall({0, 1}, {0, 5}, 0, kHeight_m);
  polygon(cloud, {1, 1}, 1, kPi, 1.5 * kPi, 200);
  cloud.wall({1, 0}, {5, 0}, 0, kHeight_m);
  const DetectLinesResult result = lines_of(cloud);
  ASSERT_EQ(result.arcs, 1U);
  double length = 0;
  for (const WallLine& chord : chords(result)) {
    length += chord.length();
    EXPECT_NEAR((0.5 * (chord.a + chord.b) - Vec2(1, 1)).norm(), 1, 0.02);
  }
  EXPECT_NEAR(length, kPi / 2, 0.3);
}

TEST(Arcs, TruePolygonsAndCornersAreNone) {
  SyntheticCloud cloud(0.005, 400);
  cloud.room({-8, -8}, {8, 8}, 0, kHeight_m);
  polygon(cloud, {0, 0}, 4.5, 0, kPi, 18);         // sides of 80 cm
  polygon(cloud, {0, -5}, 2, 0, 2 * kPi, 8);       // an octagon
  cloud.wall({-7, -7}, {-4, -7.3}, 0, kHeight_m);  // somewhat oblique
  EXPECT_EQ(lines_of(cloud).arcs, 0U);
}

}  // namespace
}  // namespace roomcut::detect_lines

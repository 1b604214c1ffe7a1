// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include "stages/detect_lines/detect_lines.h"
#include "stages/slice/slice.h"
#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::detect_lines {
namespace {

using testing::SyntheticCloud;

constexpr double kHeight_m = 3.2;

DetectLinesResult lines_of(const SyntheticCloud& cloud) {
  return detect_lines(slice::slice_cloud(cloud.header(), cloud.source(), {}).slices, {});
}

void polygon(SyntheticCloud& cloud, const Vec2& centre, double radius, int corners, double turn, double low,
             double high) {
  const auto corner = [&](int k) -> Vec2 {
    const double angle = turn + 2 * std::numbers::pi * k / corners;
    return centre + radius * Vec2(std::cos(angle), std::sin(angle));
  };
  for (int k = 0; k < corners; ++k) cloud.wall(corner(k), corner(k + 1), low, high);
}

/// A square column of this edge.
void square(SyntheticCloud& cloud, const Vec2& centre, double edge_m, double turn = 0, double low = 0,
            double high = kHeight_m) {
  polygon(cloud, centre, edge_m / std::sqrt(2.0), 4, turn + std::numbers::pi / 4, low, high);
}

/// The lines that are sides of columns.
std::vector<WallLine> sides(const DetectLinesResult& result) {
  std::vector<WallLine> found;
  for (const WallLine& line : result.lines.lines) {
    if (line.extra_json.find("column") != std::string::npos) found.push_back(line);
  }
  return found;
}

/// Largest distance of the four true sides from the nearest line of their direction that covers them.
double worst_side(const std::vector<WallLine>& lines, const Vec2& centre, double edge_m, double turn) {
  double worst = 0;
  for (int k = 0; k < 4; ++k) {
    const double angle = turn + k * std::numbers::pi / 2;
    const Vec2 middle = centre + 0.5 * edge_m * Vec2(std::cos(angle), std::sin(angle));
    double nearest = 1;
    for (const WallLine& line : lines) {
      const double t = line.line().along(middle);
      const auto [t0, t1] = std::minmax({line.line().along(line.a), line.line().along(line.b)});
      if (t0 < t && t < t1 && angle_between(line.line().theta, normalised(angle, 0).theta) < 0.05) {
        nearest = std::min(nearest, std::abs(line.line().distance(middle)));
      }
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(Columns, SquareOnesOfTwentyToEightyCentimetresAreFourLinesEach) {
  for (const double edge : {0.2, 0.3, 0.5, 0.8}) {
    for (const double noise : {0.002, 0.008}) {
      SyntheticCloud cloud(noise, 500);
      cloud.room({0, 0}, {12, 9}, 0, kHeight_m);
      square(cloud, {4, 3}, edge, 0.3);
      square(cloud, {8, 6.2}, edge);
      const DetectLinesResult result = lines_of(cloud);
      EXPECT_EQ(sides(result).size(), 8U) << edge << " " << noise;
      EXPECT_EQ(result.lines.lines.size(), 12U) << edge << " " << noise;
      EXPECT_LT(worst_side(sides(result), {4, 3}, edge, 0.3), 0.006) << edge << " " << noise;
      EXPECT_LT(worst_side(sides(result), {8, 6.2}, edge, 0), 0.006) << edge << " " << noise;
    }
  }
}

TEST(Columns, ARoundOneIsAPolygonOfItsArea) {
  for (const double radius : {0.1, 0.2, 0.4}) {
    SyntheticCloud cloud(0.004, 500);
    cloud.room({0, 0}, {12, 9}, 0, kHeight_m);
    polygon(cloud, {5, 4}, radius, 60, 0, 0, kHeight_m);
    const std::vector<WallLine> found = sides(lines_of(cloud));
    EXPECT_EQ(found.size(), radius < 0.25 ? 8U : 12U);
    double area = 0;
    for (const WallLine& line : found) {
      area += 0.5 * line.length() * std::abs(line.line().distance({5, 4}));
    }
    EXPECT_NEAR(area / (std::numbers::pi * radius * radius), 1, 0.06) << radius;
  }
}

TEST(Columns, WhatDoesNotReachTheCeilingIsNone) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {12, 9}, 0, kHeight_m);
  square(cloud, {4, 3}, 0.5, 0.2, 0, kHeight_m - 0.4);  // a shelf
  square(cloud, {8, 6}, 0.4, 0, 0, 2.0);
  polygon(cloud, {9, 3}, 0.2, 30, 0, 0, 1.8);  // somebody
  EXPECT_TRUE(sides(lines_of(cloud)).empty());
}

TEST(Columns, APlantUpToTheCeilingIsNone) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {8, 6}, 0, 2.6);
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Vec2 at(4 + 0.6 * random_unit(7, 1, i), 3 + 0.6 * random_unit(7, 2, i));
    const double turn = 6.28 * random_unit(7, 3, i);
    cloud.wall(at, at + 0.05 * Vec2(std::cos(turn), std::sin(turn)), 1.5, 2.6, SurfaceClass::kNone);
  }
  EXPECT_TRUE(sides(lines_of(cloud)).empty());
}

TEST(Columns, ASmallRoomBetweenOthersIsNone) {
  SyntheticCloud cloud;
  for (const double x : {0.0, 1.5, 3.0}) {
    cloud.room({x, 0}, {x + 1.4, 1.6}, 0, 2.6);
    cloud.room({x, 1.7}, {x + 1.4, 3.3}, 0, 2.6);
    cloud.room({x, 3.4}, {x + 1.4, 5.0}, 0, 2.6);
  }
  for (const WallLine& side : sides(lines_of(cloud))) {
    const Vec2 off = side.centre() - Vec2(2.2, 2.5);  // the middle one; around it all is unseen
    EXPECT_GT(off.cwiseAbs().maxCoeff(), 0.9);
  }
}

TEST(Columns, OfEqualOnesTheHalfSeenAreFoundToo) {
  SyntheticCloud cloud(0.003, 500);
  cloud.room({0, 0}, {16, 9}, 0, kHeight_m);
  for (const double x : {3.0, 6.1, 9.2}) polygon(cloud, {x, 3.3 + 0.2 * x}, 0.2, 60, 0, 0, kHeight_m);
  for (int k = 0; k < 26; ++k) {  // of the fourth only 156 degrees were seen
    const auto at = [&](int i) -> Vec2 {
      const double angle = 2 * std::numbers::pi * i / 60;
      return Vec2(12.3, 4) + 0.2 * Vec2(std::cos(angle), std::sin(angle));
    };
    cloud.wall(at(k), at(k + 1), 0, kHeight_m);
  }
  std::set<std::string> columns;
  for (const WallLine& side : sides(lines_of(cloud))) {
    if (std::abs(side.centre().x() - 12.3) < 0.25) columns.insert(side.extra_json);
  }
  EXPECT_EQ(columns.size(), 1U);
}

TEST(Columns, SidesInARowAreOneLine) {
  SyntheticCloud cloud(0.005, 400);
  cloud.room({0, 0}, {20, 9}, 0, kHeight_m);
  for (const double x : {4.0, 8.0, 12.0, 16.0}) square(cloud, {x, 4.5}, 0.4);
  const std::vector<WallLine> found = sides(lines_of(cloud));
  EXPECT_EQ(found.size(), 10U);  // two along the row, two across it for each
  EXPECT_NE(found.front().extra_json.find("c0001"), std::string::npos);
  EXPECT_NE(found.front().extra_json.find("c0004"), std::string::npos);
}

TEST(Columns, APierOfOneMetreAndAHalfSparselySeenHasFourSides) {
  SyntheticCloud cloud(0.005, 30);
  cloud.room({0, 0}, {24, 18}, 0, 4);
  for (const double x : {6.0, 12.0, 18.0}) {
    for (const double y : {6.0, 12.0}) square(cloud, {x, y}, 1.5, 0, 0, 4);
  }
  const DetectLinesResult result = lines_of(cloud);
  for (const double x : {6.0, 12.0, 18.0}) {
    for (const double y : {6.0, 12.0}) EXPECT_LT(worst_side(result.lines.lines, {x, y}, 1.5, 0), 0.01);
  }
}

}  // namespace
}  // namespace roomcut::detect_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace roomcut::slice {
namespace {

/// A plane that rises from `low` to `high` along x.
SlopedPlane plane_between(double low, double high, double area_m2 = 40) {
  SlopedPlane plane;
  plane.gradient = {(high - low) / 4, 0};
  plane.c = low;
  plane.area_m2 = area_m2;
  plane.outline = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  return plane;
}

std::vector<double> steps(const std::vector<double>& heights, const std::vector<SlopedPlane>& planes) {
  std::vector<Level> levels;
  for (const double z : heights) levels.push_back({z, z, z, 10, 10});
  add_steps(levels, {}, {}, planes, 0.3);
  std::vector<double> found;
  for (const Level& level : levels) {
    if (level.step) found.push_back(level.z);
  }
  EXPECT_TRUE(
      std::is_sorted(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.z < b.z; }));
  return found;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9);
}

TEST(Steps, CutASlopeIntoEqualPartsWithAStepInTheMiddleOfEach) {
  expect_near(steps({0, 3}, {plane_between(1, 1.9)}), {1.15, 1.45, 1.75});
}

TEST(Steps, StandInEveryGapBetweenLevelsThatAPlanePasses) {
  expect_near(steps({0, 1.2, 3}, {plane_between(0.9, 1.5)}), {1.05, 1.35});
  expect_near(steps({0, 1.2, 3}, {plane_between(0.9, 1.25)}), {1.05});  // 5 cm above the level are none
}

TEST(Steps, AreTwiceAsHighWhereLittleSlopes) {
  expect_near(steps({0, 3}, {plane_between(1, 2.2, 3)}), {1.3, 1.9});
  EXPECT_EQ(steps({0, 3}, {plane_between(1, 2.2, 6), plane_between(1, 2.2, 6)}).size(), 4U);
}

TEST(Steps, PlanesOfEqualHeightsShareThem) {
  EXPECT_EQ(steps({0, 3}, {plane_between(1, 1.9), plane_between(1, 1.9)}).size(), 3U);
  EXPECT_EQ(steps({0, 3}, {plane_between(1, 1.9), plane_between(1.2, 1.9)}).size(), 3U);
}

TEST(Steps, ALowPlaneBetweenTwoOfThemGetsItsOwn) {
  expect_near(steps({0, 3}, {plane_between(1, 1.9), plane_between(1.23, 1.37)}), {1.15, 1.3, 1.45, 1.75});
}

TEST(Steps, KeepTenCentimetresFromOtherLevels) {
  expect_near(steps({0, 3}, {plane_between(0.0, 0.12)}), {0.1});
  EXPECT_TRUE(steps({0, 0.15, 3}, {plane_between(0, 0.15)}).empty());  // the gap has no room
}

}  // namespace
}  // namespace roomcut::slice

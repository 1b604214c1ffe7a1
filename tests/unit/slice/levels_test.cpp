// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/levels.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::slice {
using namespace roomcut::testing;

namespace {

using testing::SyntheticCloud;

LevelRules rules_for(const SyntheticCloud& cloud) {
  return {cloud.noise(), std::max(0.007, 1.5 * cloud.noise()), 0.1, 4.0};
}

std::vector<Level> levels_of(const SyntheticCloud& cloud, std::vector<Level>* rejected = nullptr) {
  const LevelRules rules = rules_for(cloud);
  const HeightSurvey survey = survey_heights(cloud.header(), cloud.source(), rules.raster_m, 0.005);
  std::vector<SurfaceCell> cells = surface_cells(survey.patches, rules.noise_m);
  measure_drift(cells, rules.raster_m, rules.noise_m);
  std::vector<Level> levels = find_levels(survey, cells, rules, rejected);
  add_caps(levels, survey, cells, {}, 0.2);
  return levels;
}

std::vector<double> heights(const std::vector<Level>& levels) {
  std::vector<double> z;
  z.reserve(levels.size());
  for (const Level& level : levels) z.push_back(level.z);
  return z;
}

void expect_heights(const std::vector<Level>& levels, const std::vector<double>& expected, double tolerance) {
  const std::vector<double> found = heights(levels);
  ASSERT_EQ(found.size(), expected.size()) << ::testing::PrintToString(found);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], tolerance);
}

TEST(Levels, FloorAndCeilingAreFoundWithinTwoMillimetres) {
  for (const double noise : {0.0, 0.003, 0.005}) {
    SyntheticCloud cloud(noise);
    cloud.room({0, 0}, {5, 4}, 0.0, 2.5);
    expect_heights(levels_of(cloud), {0.0, 2.5}, 0.002);
  }
}

TEST(Levels, NoiseOfTwoCentimetresMovesThemByLessThanOneCentimetre) {
  SyntheticCloud cloud(0.02);
  cloud.room({0, 0}, {5, 4}, 0.0, 2.5);
  expect_heights(levels_of(cloud), {0.0, 2.5}, 0.005);
}

TEST(Levels, CeilingsFourCentimetresApartInDifferentRoomsStayApart) {
  for (const double noise : {0.003, 0.005}) {
    SyntheticCloud cloud(noise);
    cloud.room({0, 0}, {5, 4}, 0.0, 2.50);
    cloud.room({5.1, 0}, {9, 4}, 0.0, 2.54);
    expect_heights(levels_of(cloud), {0.0, 2.50, 2.54}, 0.003);
  }
}

TEST(Levels, CeilingsThreeCentimetresApartStayApart) {
  SyntheticCloud cloud(0.005);
  cloud.room({0, 0}, {5, 4}, 0.0, 2.50);
  cloud.room({5.1, 0}, {9, 4}, 0.0, 2.53);
  expect_heights(levels_of(cloud), {0.0, 2.50, 2.53}, 0.003);
}

TEST(Levels, AStepOfFiveCentimetresInOneCeilingIsTwoLevels) {
  SyntheticCloud cloud(0.004);
  cloud.room({0, 0}, {6, 4}, 0.0, 2.50);
  cloud.horizontal({6, 0}, {12, 4}, 2.55);
  expect_heights(levels_of(cloud), {0.0, 2.50, 2.55}, 0.003);
}

TEST(Levels, ADriftingFloorIsOneLevel) {
  SyntheticCloud cloud(0.006);
  // 24 cm from end to end, in waves as a mobile scan drifts: a plain histogram has several peaks.
  const auto drift = [](const Vec2& p) { return 0.006 * p.x() + 0.03 * std::sin(0.5 * p.x()); };
  cloud.horizontal({0, 0}, {25, 8}, drift);
  cloud.horizontal({0, 0}, {25, 8}, [&](const Vec2& p) { return 2.7 + drift(p); });
  const std::vector<Level> levels = levels_of(cloud);
  ASSERT_EQ(levels.size(), 2U) << ::testing::PrintToString(heights(levels));
  EXPECT_GT(levels[0].area_m2, 0.9 * 200);
  EXPECT_NEAR(levels[1].z - levels[0].z, 2.7, 0.01);
}

TEST(Levels, DriftOfOneFloorDoesNotJoinCleanCeilings) {
  SyntheticCloud cloud(0.004);
  cloud.horizontal({0, 0}, {25, 8}, [](const Vec2& p) { return 0.004 * p.x(); });
  cloud.horizontal({0, 0}, {12, 8}, 2.50);
  cloud.horizontal({12.1, 0}, {25, 8}, 2.54);
  const std::vector<Level> levels = levels_of(cloud);
  ASSERT_EQ(levels.size(), 3U) << ::testing::PrintToString(heights(levels));
  EXPECT_NEAR(levels[1].z, 2.50, 0.003);
  EXPECT_NEAR(levels[2].z, 2.54, 0.003);
}

TEST(Levels, ATableIsNoLevel) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {6, 5}, 0.0, 2.5);
  cloud.horizontal({1, 1}, {2.6, 2.2}, 0.74);
  cloud.horizontal({4, 1}, {5.6, 2.2}, 0.74);
  cloud.horizontal({1, 3.4}, {2.6, 4.6}, 0.74);
  std::vector<Level> rejected;
  expect_heights(levels_of(cloud, &rejected), {0.0, 2.5}, 0.002);
  ASSERT_EQ(rejected.size(), 1U);
  EXPECT_NEAR(rejected[0].area_m2, 5.76, 0.3);
  EXPECT_NEAR(rejected[0].component_m2, 1.92, 0.3);
}

TEST(Levels, ALargeTableOverAVisibleFloorIsNoLevel) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {9, 6}, 0.0, 2.5);
  cloud.horizontal({1, 1}, {8, 3}, 0.74);
  expect_heights(levels_of(cloud), {0.0, 2.5}, 0.002);
}

TEST(Levels, AStageOfTwentySquareMetresIsALevel) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {9, 6}, 0.0, 3.5);
  cloud.horizontal({9, 0}, {12.5, 6}, 0.8);
  cloud.wall({9, 0}, {9, 6}, 0.0, 0.8);
  expect_heights(levels_of(cloud), {0.0, 0.8, 3.5}, 0.002);
}

TEST(Levels, TheRaisedFloorOfASmallRoomIsALevelThoughFloorsGoOnBeyondItsThinWalls) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {4, 10}, 0.0, 2.5);
  cloud.room({7.3, 0}, {11, 10}, 0.0, 2.5);
  cloud.room({4.1, 0}, {7.2, 3.5}, 0.3, 2.5);
  cloud.room({4.1, 3.6}, {7.2, 10}, 0.0, 2.5);
  expect_heights(levels_of(cloud), {0.0, 0.3, 2.5}, 0.002);
}

TEST(Levels, ABedInACornerIsNoneThoughNoFloorIsSeenUnderIt) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {4.5, 4}, 0.0, 2.5);
  cloud.horizontal({4.6, 0}, {6.9, 2.2}, 0.5);
  cloud.horizontal({6.9, 0}, {12, 2.2}, 0.0);
  cloud.horizontal({4.6, 2.2}, {12, 8}, 0.0);
  cloud.horizontal({4.6, 0}, {12, 8}, 2.5);
  cloud.wall({4.6, 0}, {4.6, 8}, 0.0, 2.5);
  cloud.wall({4.6, 0}, {12, 0}, 0.0, 2.5);
  expect_heights(levels_of(cloud), {0.0, 2.5}, 0.002);
}

TEST(Levels, AFloorOverTheCeilingBelowIsNoTable) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {12, 8}, 0.0, 2.5);
  cloud.room({0, 0}, {3, 3}, 2.8, 5.0);
  expect_heights(levels_of(cloud), {0.0, 2.5, 2.8, 5.0}, 0.002);
}

TEST(Levels, AVaultHasOneLevelAtItsCrown) {
  SyntheticCloud cloud(0.003);
  cloud.horizontal({0, 0}, {12, 12}, 0.0);
  cloud.horizontal({0, 0}, {12, 12}, [](const Vec2& p) { return 4.0 - 0.006 * (p.x() - 6) * (p.x() - 6); });
  const std::vector<Level> levels = levels_of(cloud);
  ASSERT_EQ(levels.size(), 2U) << ::testing::PrintToString(heights(levels));
  EXPECT_GT(levels[1].z, 3.85);
  EXPECT_LT(levels[1].z, 4.0);
}

TEST(Levels, ARoomOfThreeSquareMetresHasFloorAndCeiling) {
  SyntheticCloud cloud(0.004);
  cloud.room({0, 0}, {2.0, 1.5}, 0.0, 2.4);
  expect_heights(levels_of(cloud), {0.0, 2.4}, 0.002);
}

TEST(Levels, DensityThatFallsOffChangesNoArea) {
  SyntheticCloud cloud(0.004, 2000);
  cloud.thin([](const Vec2& p) { return 1 / (1 + p.squaredNorm()); });
  cloud.room({0, 0}, {5, 4}, 0.0, 2.5);
  const std::vector<Level> levels = levels_of(cloud);
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_NEAR(levels[0].area_m2, 20, 0.6);
}

TEST(Levels, WallsThatGoOnPastTheLastLevelGetACap) {
  SyntheticCloud cloud;
  cloud.horizontal({0, 0}, {5, 4}, 0.0);
  cloud.wall({0, 0}, {5, 0}, 0.0, 2.6);
  cloud.wall({5, 0}, {5, 4}, 0.0, 2.6);
  const std::vector<Level> levels = levels_of(cloud);
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_FALSE(levels[0].cap);
  EXPECT_TRUE(levels[1].cap);
  EXPECT_NEAR(levels[1].z, 2.6, 0.05);
}

TEST(Levels, ARaisedFloorAboveALowCeilingIsNoFurnitureOfItAtAnyAngle) {
  // Rooms beside the narrow hall are higher, so walls go on past its ceiling; its own end below, pipes lie on
  // it.
  for (int step = 0; step < 6; ++step) {
    SyntheticCloud cloud(0.005, 300);
    cloud.place(step * std::numbers::pi / 18, {0.05 * step, 0.065 * step});
    cloud.horizontal({0, 4.1}, {12, 6}, 0.0);
    cloud.horizontal({0, 4.1}, {12, 6}, 2.4);
    for (const double y : {4.1, 6.0}) cloud.wall({0, y}, {12, y}, 0, 2.0);
    cloud.wall({2, 5}, {10, 5}, 2.45, 2.7);
    cloud.room({0, 0}, {12, 4}, 0.0, 2.7);
    cloud.room({0, 6.1}, {12, 10}, 0.0, 2.7);
    cloud.room({0, 0}, {7.9, 10}, 3.1, 5.7);
    cloud.room({8, 3.6}, {12, 6.5}, 3.25, 5.7);
    expect_heights(levels_of(cloud), {0.0, 2.4, 2.7, 3.1, 3.25, 5.7}, 0.005);
  }
}

TEST(Levels, ARoofThatWasScannedFromAboveIsNoneWhateverItsParapet) {
  for (const double parapet : {0.4, 0.9, 1.3}) {
    SyntheticCloud cloud;
    cloud.room({0, 0}, {6, 5}, 0.0, 2.6);
    cloud.horizontal({-0.3, -0.3}, {6.3, 5.3}, 2.95);
    for (const double y : {-0.3, 5.3}) cloud.wall({-0.3, y}, {6.3, y}, 2.95, 2.95 + parapet);
    expect_heights(levels_of(cloud), {0.0, 2.6}, 0.005);
  }
}

TEST(Levels, AnUpperFloorWhoseCeilingWasNotSeenIsNoRoof) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {6, 5}, 0.0, 2.6);
  cloud.horizontal({0, 0}, {6, 5}, 2.95);
  for (const double y : {0.0, 5.0}) cloud.wall({0, y}, {6, y}, 2.95, 5.2);
  const std::vector<Level> levels = levels_of(cloud);
  ASSERT_EQ(levels.size(), 4U);
  EXPECT_TRUE(levels.back().cap);
}

TEST(Levels, WallsThatEndAtTheCeilingGetNone) {
  SyntheticCloud cloud(0.02);
  cloud.room({0, 0}, {5, 4}, 0.0, 2.5);
  for (const Level& level : levels_of(cloud)) EXPECT_FALSE(level.cap);
}

}  // namespace
}  // namespace roomcut::slice

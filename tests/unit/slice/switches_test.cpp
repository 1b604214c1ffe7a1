// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numeric>

#include "stages/slice/slice.h"
#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::slice {
using namespace roomcut::testing;

namespace {

using testing::SyntheticCloud;

std::vector<double> heights(const SyntheticCloud& cloud, const SliceParams& params) {
  std::vector<double> z;
  for (const Level& level : slice_cloud(cloud.header(), cloud.source(), params).slices.levels) {
    z.push_back(level.z);
  }
  return z;
}

/// The parameters with one switch off.
SliceParams without(bool SliceParams::*addition) {
  SliceParams params;
  params.*addition = false;
  return params;
}

TEST(Switches, WithoutByAreaTheHistogramCountsPoints) {
  SyntheticCloud cloud;
  cloud.thin([](const Vec2& p) { return p.x() < 3 ? 1.0 : 0.2; });
  cloud.room({0, 0}, {6, 4}, 0.0, 2.5);
  const auto sum = [&](const SliceParams& params) {
    const VerticalHistogram& histogram = slice_cloud(cloud.header(), cloud.source(), params).slices.histogram;
    return std::accumulate(histogram.area_m2.begin(), histogram.area_m2.end(), 0.0);
  };
  EXPECT_NEAR(sum({}), 48, 1);
  EXPECT_NEAR(sum(without(&SliceParams::by_area)), 0.6 * 48, 1);
}

TEST(Switches, WithoutDriftAFloorThatDriftsIsTornApart) {
  SyntheticCloud cloud(0.006);
  const auto drift = [](const Vec2& p) { return 0.006 * p.x() + 0.03 * std::sin(0.5 * p.x()); };
  cloud.horizontal({0, 0}, {25, 8}, drift);
  cloud.horizontal({0, 0}, {25, 8}, [&](const Vec2& p) { return 2.7 + drift(p); });
  cloud.wall({0, 0}, {0, 8}, 0.2, 2.6);
  EXPECT_EQ(heights(cloud, {}).size(), 2U);
  EXPECT_GT(heights(cloud, without(&SliceParams::drift)).size(), 2U);
}

TEST(Switches, WithoutJoinModesCeilingsOfTwoCentimetresAreTwoLevels) {
  SyntheticCloud cloud(0.002);
  cloud.room({0, 0}, {5, 4}, 0.0, 2.500);
  cloud.room({5.1, 0}, {9, 4}, 0.0, 2.522);
  EXPECT_EQ(heights(cloud, {}).size(), 2U);
  EXPECT_EQ(heights(cloud, without(&SliceParams::join_modes)).size(), 3U);
}

TEST(Switches, WithoutConnectedScatteredSurfacesOfOneHeightMakeALevel) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {12, 8}, 0.0, 2.5);
  for (const double x : {1.0, 4.0, 7.0, 10.0}) cloud.horizontal({x, 1}, {x + 1.2, 2.2}, 1.6);
  EXPECT_EQ(heights(cloud, {}).size(), 2U);
  EXPECT_EQ(heights(cloud, without(&SliceParams::connected)).size(), 3U);
}

TEST(Switches, WithoutFurnitureALargeTableIsALevel) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {10, 8}, 0.0, 2.5);
  cloud.horizontal({2, 2}, {7, 3.2}, 0.75);
  EXPECT_EQ(heights(cloud, {}).size(), 2U);
  EXPECT_EQ(heights(cloud, without(&SliceParams::furniture)).size(), 3U);
}

TEST(Switches, WithoutUprightOnlyHorizontalPointsFillTheWallSlices) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {6, 4}, 0.0, 2.5);
  cloud.horizontal({2, 2}, {3, 3}, 2.2);
  const auto cells = [&](const SliceParams& params) {
    return slice_cloud(cloud.header(), cloud.source(), params).slices.wall_slices.front().size();
  };
  EXPECT_GT(cells(without(&SliceParams::upright_only)), cells({}) + 250);
}

TEST(Switches, CapsBeyondAnyReachAreNone) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {6, 4}, 0.0, 2.5);
  cloud.wall({0, 0}, {6, 0}, 2.5, 4.5);
  SliceParams params;
  EXPECT_EQ(heights(cloud, params).size(), 3U);
  params.cap_reach_m = 1000;
  EXPECT_EQ(heights(cloud, params).size(), 2U);
}

}  // namespace
}  // namespace roomcut::slice

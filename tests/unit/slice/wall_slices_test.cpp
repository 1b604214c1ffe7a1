// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/wall_slices.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::slice {
using namespace roomcut::testing;

namespace {

using testing::SyntheticCloud;

std::vector<Level> levels_at(const std::vector<double>& heights, bool cap = false) {
  std::vector<Level> levels;
  for (const double z : heights) levels.push_back({z, z - 0.02, z + 0.02, 10, 10, false});
  levels.back().cap = cap;
  return levels;
}

double length_of(const OccupancyGrid& grid) {
  return std::accumulate(grid.weight_m.begin(), grid.weight_m.end(), 0.0);
}

TEST(EvidenceRanges, ATallSliceCountsItsTopQuarterOnly) {
  const auto ranges = evidence_ranges(levels_at({0, 2.5}), 1.5, 0.25);
  ASSERT_EQ(ranges.size(), 1U);
  EXPECT_NEAR(ranges[0].hi, 2.48, 1e-9);
  EXPECT_NEAR(ranges[0].hi - ranges[0].lo, 0.25 * 2.46, 1e-9);
  EXPECT_EQ(ranges[0].bins, 5);
}

TEST(EvidenceRanges, ALowSliceAndASliceUnderACapCountWhole) {
  EXPECT_NEAR(evidence_ranges(levels_at({0, 1.0}), 1.5, 0.25)[0].lo, 0.02, 1e-9);
  EXPECT_NEAR(evidence_ranges(levels_at({0, 2.5}, true), 1.5, 0.25)[0].lo, 0.02, 1e-9);
}

TEST(EvidenceRanges, BandsThatTouchLeaveNoEvidence) {
  const auto ranges = evidence_ranges(levels_at({2.50, 2.54}), 1.5, 0.25);
  EXPECT_EQ(ranges[0].bins, 0);
}

TEST(WallSlices, AWallOfFiveMetresWeighsFiveMetresAtAnyDensity) {
  for (const double density : {150.0, 500.0, 4000.0}) {
    SyntheticCloud cloud(0.002, density);
    cloud.wall({0.01, 1.02}, {5.01, 1.02}, 0, 2.5);
    const auto grids =
        occupy_wall_slices(cloud.source(), evidence_ranges(levels_at({0, 2.5}), 1.5, 0.25), 0.04);
    ASSERT_EQ(grids.size(), 1U);
    EXPECT_NEAR(length_of(grids[0]), 5.0, 0.5) << density;
  }
}

TEST(WallSlices, AWallWeighsItsLengthHoweverTheGridLies) {
  const auto ranges = evidence_ranges(levels_at({0, 1.0}), 1.5, 0.25);
  for (const double angle : {0.0, 0.3, 0.25 * std::numbers::pi}) {
    for (const double shift :
         {0.0, 0.01, 0.02, 0.03}) {  // from between two rows of cells to the middle of one
      SyntheticCloud cloud(0.004, 2000);
      cloud.place(angle, {0.5 * shift, shift});
      cloud.wall({0, 1}, {5, 1}, 0.3, 0.8);  // half of the slice's height
      const auto grids = occupy_wall_slices(cloud.source(), ranges, 0.04);
      EXPECT_NEAR(length_of(grids[0]), 5 * 0.5 / 0.96, 0.1) << angle << ", " << shift;
    }
  }
}

TEST(WallSlices, CellsAreSortedAndHoldTheirCentroids) {
  SyntheticCloud cloud;
  cloud.room({-3, -2}, {2, 2}, 0, 2.5);
  const auto grids =
      occupy_wall_slices(cloud.source(), evidence_ranges(levels_at({0, 2.5}), 1.5, 0.25), 0.04);
  const OccupancyGrid& grid = grids[0];
  ASSERT_GT(grid.size(), 400U);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_EQ(grid.ix[i], static_cast<int>(std::floor(grid.x[i] / 0.04F + 1e-4F * (grid.x[i] < 0 ? -1 : 1))));
    EXPECT_TRUE(i == 0 || std::pair(grid.iy[i - 1], grid.ix[i - 1]) < std::pair(grid.iy[i], grid.ix[i]));
  }
}

TEST(WallSlices, FurnitureBelowTheTopQuarterIsNotSeen) {
  SyntheticCloud cloud;
  cloud.wall({1, 1}, {3, 1}, 0, 1.8);
  cloud.wall({1, 3}, {3, 3}, 0, 1.8, SurfaceClass::kNone);
  const auto grids =
      occupy_wall_slices(cloud.source(), evidence_ranges(levels_at({0, 2.5}), 1.5, 0.25), 0.04);
  EXPECT_EQ(grids[0].size(), 0U);
}

TEST(WallSlices, HorizontalAndSlopedPointsAreNoEvidence) {
  SyntheticCloud cloud;
  cloud.horizontal({0, 0}, {2, 2}, 2.2);
  cloud.wall({0, 0}, {2, 0}, 2, 2.4, SurfaceClass::kSloped);
  const auto grids =
      occupy_wall_slices(cloud.source(), evidence_ranges(levels_at({0, 2.5}), 1.5, 0.25), 0.04);
  EXPECT_EQ(grids[0].size(), 0U);
}

TEST(WallSlices, AzimuthIsThatOfTheWallAlsoAcrossTheEndOfTheRange) {
  for (const double angle : {0.0, 0.3, 1.2, 3.13}) {
    SyntheticCloud cloud;
    cloud.place(angle, {0, 0});
    cloud.wall({1, 0}, {1, 4}, 0, 2.5);  // normal along x
    const auto grids =
        occupy_wall_slices(cloud.source(), evidence_ranges(levels_at({0, 2.5}), 1.5, 0.25), 0.04);
    for (std::size_t i = 0; i < grids[0].size(); ++i) {
      EXPECT_LT(angle_between(azimuth_of(grids[0].azimuth[i]), angle), 0.02);
      EXPECT_GT(grids[0].azimuth_trust[i], 250);
    }
  }
}

}  // namespace
}  // namespace roomcut::slice

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/slice.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "common/errors/codes.h"
#include "stages/slice/wall_slices.h"
#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::slice {
using namespace roomcut::testing;

namespace {

using testing::SyntheticCloud;

std::string code_of(const SyntheticCloud& cloud) {
  try {
    slice_cloud(cloud.header(), cloud.source(), {});
  } catch (const StageError& error) {
    return error.problems().front().code.id;
  }
  return "none";
}

SyntheticCloud two_storeys() {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {6, 4}, 0.0, 2.5);
  cloud.room({6.1, 0}, {9, 4}, 0.0, 2.4);
  cloud.room({0, 0}, {6, 4}, 2.8, 5.3);
  return cloud;
}

TEST(Slice, WallSlicesLieBetweenTheLevels) {
  const SyntheticCloud cloud = two_storeys();
  const SliceResult result = slice_cloud(cloud.header(), cloud.source(), {});
  ASSERT_EQ(result.slices.levels.size(), 5U);
  ASSERT_EQ(result.slices.wall_slices.size(), 4U);
  EXPECT_GT(result.slices.wall_slices[0].size(), 600U);  // both rooms below 2.4 m
  EXPECT_GT(result.slices.wall_slices[3].size(), 450U);  // the upper room
  EXPECT_EQ(result.slices.wall_slices[2].size(), 0U);    // the slab between the storeys
  EXPECT_NEAR(result.slices.tau_m, 0.04, 1e-9);
}

TEST(Slice, TheHistogramHoldsAllHorizontalArea) {
  const SyntheticCloud cloud = two_storeys();
  const SliceResult result = slice_cloud(cloud.header(), cloud.source(), {});
  double area = 0;
  for (const double bin : result.slices.histogram.area_m2) area += bin;
  EXPECT_NEAR(area, 2 * (24 + 11.6 + 24), 0.5);
}

TEST(Slice, ASparseScanGetsLargerCells) {
  SyntheticCloud cloud(0.005, 60);
  cloud.room({0, 0}, {6, 4}, 0.0, 2.5);
  const SliceResult result = slice_cloud(cloud.header(), cloud.source(), {});
  EXPECT_EQ(result.slices.levels.size(), 2U);
  EXPECT_GT(result.slices.tau_m, 0.06);
}

TEST(Slice, ParametersOverrideWhatIsDerived) {
  const SyntheticCloud cloud = two_storeys();
  SliceParams params;
  params.tau_m = 0.07;
  params.min_component_m2 = 20;
  const SliceResult result = slice_cloud(cloud.header(), cloud.source(), params);
  EXPECT_EQ(result.slices.tau_m, 0.07);
  EXPECT_EQ(result.slices.levels.size(), 4U);  // the ceiling of 11.6 m^2 is none now
}

TEST(Slice, WallsWithoutFloorAndCeilingAreErrorN01) {
  SyntheticCloud cloud;
  cloud.wall({0, 0}, {5, 0}, 0, 2.5);
  EXPECT_EQ(code_of(cloud), "N01");
}

TEST(Slice, AFloorAloneIsErrorN01) {
  SyntheticCloud cloud;
  cloud.horizontal({0, 0}, {5, 5}, 0.0);
  EXPECT_EQ(code_of(cloud), "N01");
}

TEST(Slice, FloorAndCeilingWithoutWallsAreErrorN02) {
  SyntheticCloud cloud;
  cloud.horizontal({0, 0}, {5, 5}, 0.0);
  cloud.horizontal({0, 0}, {5, 5}, 2.5);
  EXPECT_EQ(code_of(cloud), "N02");
}

/// A floor of 8 m x 10 m under a roof of 45 degrees whose ridge runs along x 4.5 m above it.
SyntheticCloud gable_roof(double floor_z = 0) {
  SyntheticCloud cloud(0.004, 600);
  cloud.horizontal({0, 0}, {8, 9}, floor_z);
  cloud.surface(
      {0, 0}, {8, 9}, [floor_z](const Vec2& p) { return floor_z + 4.5 - std::abs(p.y() - 4.5); },
      SurfaceClass::kSloped);
  for (const double x : {0.0, 8.0}) {
    for (int i = 0; i < 18; ++i) {
      const double y = 0.5 * i;
      cloud.wall({x, y}, {x, y + 0.5}, floor_z, floor_z + 4.5 - std::abs(y + 0.25 - 4.5));
    }
  }
  return cloud;
}

TEST(Slice, ARoofBecomesStepsOfThirtyCentimetres) {
  const SyntheticCloud cloud = gable_roof();
  const SliceResult result = slice_cloud(cloud.header(), cloud.source(), {});
  std::size_t steps = 0;
  for (const Level& level : result.slices.levels) steps += level.step ? 1U : 0U;
  EXPECT_GE(steps, 12U);
  EXPECT_LE(steps, 15U);
  EXPECT_FALSE(result.slices.levels.front().step);
  EXPECT_TRUE(result.slices.levels.back().cap);
  for (std::size_t k = 1; k < result.slices.levels.size(); ++k) {
    const double apart = result.slices.levels[k].z - result.slices.levels[k - 1].z;
    EXPECT_GT(apart, 0.1);
    EXPECT_LT(apart, 0.6);
  }
}

TEST(Slice, ARoofsStepsLieAtTheSameHeightsOfItWhereverTheBinsBegin) {
  const auto steps_over = [](double floor_z) {
    const SyntheticCloud cloud = gable_roof(floor_z);
    SliceParams params;
    params.step_m = 0.28;  // 14.5 of 0.3 m would be 14 or 15
    std::vector<double> steps;
    for (const Level& level : slice_cloud(cloud.header(), cloud.source(), params).slices.levels) {
      if (level.step) steps.push_back(level.z - floor_z);
    }
    return steps;
  };
  const std::vector<double> still = steps_over(0);
  for (const double floor_z : {0.012, 0.024, 0.037}) {
    const std::vector<double> raised = steps_over(floor_z);
    ASSERT_EQ(raised.size(), still.size());
    for (std::size_t i = 0; i < still.size(); ++i) {
      EXPECT_NEAR(raised[i], still[i], 0.006) << floor_z;
    }
  }
}

/// Of each grid between two steps of the gable roof: its cells between the end walls, and how far the
/// farthest of them lies from the roof's contour half way between the steps.
struct OnContour {
  std::size_t cells = 0;
  double farthest_m = 0;
};
std::vector<OnContour> contours(const std::vector<Level>& levels, const std::vector<OccupancyGrid>& grids) {
  std::vector<OnContour> all;
  for (std::size_t k = 0; k < grids.size(); ++k) {
    if (!levels[k].step || !levels[k + 1].step) continue;
    const double z = 0.5 * (levels[k].z + levels[k + 1].z);
    OnContour on;
    for (std::size_t i = 0; i < grids[k].size(); ++i) {
      if (grids[k].x[i] < 0.1F || grids[k].x[i] > 7.9F) continue;
      const double roof = 4.5 - std::abs(static_cast<double>(grids[k].y[i]) - 4.5);
      on.farthest_m = std::max(on.farthest_m, std::abs(roof - z));
      ++on.cells;
    }
    all.push_back(on);
  }
  return all;
}

TEST(Slice, WhereNoPlaneExplainsTheStepsTheRoofsContourBetweenThemIsWallEvidence) {
  const SyntheticCloud cloud = gable_roof();
  const std::vector<Level> levels = slice_cloud(cloud.header(), cloud.source(), {}).slices.levels;
  const auto grids = occupy_wall_slices(cloud.source(), evidence_ranges(levels, 1.5, 0.25), 0.04);
  const std::vector<OnContour> all = contours(levels, grids);
  ASSERT_GT(all.size(), 10U);
  for (const OnContour& on : all) {
    EXPECT_GT(on.cells, 220U);
    EXPECT_LT(on.farthest_m, 0.05);
  }
}

TEST(Slice, WherePlanesExplainTheStepsTheirPointsAreNoWallEvidence) {
  const SyntheticCloud cloud = gable_roof();
  const Slices slices = slice_cloud(cloud.header(), cloud.source(), {}).slices;
  ASSERT_EQ(slices.planes.size(), 2U);
  const std::vector<OnContour> all = contours(slices.levels, slices.wall_slices);
  ASSERT_GT(all.size(), 10U);
  for (const OnContour& on : all) EXPECT_EQ(on.cells, 0U);
}

TEST(Slice, StepsCanBeTurnedOff) {
  const SyntheticCloud cloud = gable_roof();
  SliceParams params;
  params.step_m = 0;
  EXPECT_EQ(slice_cloud(cloud.header(), cloud.source(), params).slices.levels.size(), 2U);
}

TEST(Slice, SlopedClutterUnderACeilingMakesNoSteps) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {8, 9}, 0.0, 2.6);
  cloud.surface(
      {1, 1}, {6, 6}, [](const Vec2& p) { return 0.5 + 0.3 * p.y(); }, SurfaceClass::kSloped);
  EXPECT_EQ(slice_cloud(cloud.header(), cloud.source(), {}).slices.levels.size(), 2U);
}

TEST(Slice, AnyNumberOfThreadsGivesTheSameResult) {
  const SyntheticCloud cloud = two_storeys();
  std::vector<SliceResult> results;
  for (const std::size_t threads : {1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(slice_cloud(cloud.header(), cloud.source(), {}));
  }
  for (const SliceResult& result : results) {
    EXPECT_EQ(result.slices.histogram.area_m2, results[0].slices.histogram.area_m2);
    ASSERT_EQ(result.slices.levels.size(), results[0].slices.levels.size());
    for (std::size_t k = 0; k < result.slices.levels.size(); ++k) {
      EXPECT_EQ(result.slices.levels[k].z, results[0].slices.levels[k].z);
    }
    for (std::size_t k = 0; k < result.slices.wall_slices.size(); ++k) {
      EXPECT_EQ(result.slices.wall_slices[k].x, results[0].slices.wall_slices[k].x);
      EXPECT_EQ(result.slices.wall_slices[k].weight_m, results[0].slices.wall_slices[k].weight_m);
    }
  }
}

}  // namespace
}  // namespace roomcut::slice

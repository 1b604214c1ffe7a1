// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/line_fit.h"

#include <gtest/gtest.h>

#include "tests/unit/detect_lines/cells_on_a_line.h"

namespace roomcut::detect_lines {
using namespace roomcut::testing;

namespace {

using testing::add_cells;
using testing::all_of;
using testing::kRules;

TEST(LineFit, FindsTheLineFromARoughStart) {
  for (const double theta : {0.0, 0.5, 1.57, 3.1}) {
    const Line2 truth{theta, 4};
    WallCells cells;
    add_cells(cells, truth, 10, 16, 0.008);
    const Line2 fit =
        fit_line(cells, all_of(cells), normalised(theta + 0.003, truth.d + 0.003 * 13 + 0.008), kRules);
    EXPECT_LT(angle_between(fit.theta, theta), 0.001);
    EXPECT_LT(std::abs(fit.distance(truth.at(13))), 0.002);
  }
}

TEST(LineFit, CellsOffTheLineDoNotPullIt) {
  const Line2 truth{0.5, 4};
  WallCells cells;
  add_cells(cells, truth, 0, 4, 0.003);
  add_cells(cells, {0.5, 4.035}, 0, 2);
  const Line2 fit = fit_line(cells, all_of(cells), {0.5, 4.002}, kRules);
  EXPECT_LT(std::abs(fit.distance(truth.at(2))), 0.001);
}

TEST(LineFit, WithFixedAngleOnlyTheOffsetMoves) {
  WallCells cells;
  add_cells(cells, {0.5, 4}, 0, 4);
  const Line2 fit = fit_line(cells, all_of(cells), {0.502, 4.0}, kRules, true);
  EXPECT_EQ(fit.theta, 0.502);
  EXPECT_LT(std::abs(fit.distance(Line2{0.5, 4}.at(2))), 1e-3);
}

TEST(Supports, CoveredLengthCountsEachPlaceOnceForAllSlices) {
  WallCells cells;
  add_cells(cells, {0, 0}, 0, 4, 0, 0);
  add_cells(cells, {0, 0}, 0, 4, 0, 1);
  const auto found = supports(cells, all_of(cells), {0, 0}, kRules);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].support_m, 4, 0.1);
  EXPECT_EQ(found[0].cells.size(), cells.size());
}

TEST(Supports, AGapOfTwoMetresJoinsAndOneOfFiveParts) {
  WallCells cells;
  add_cells(cells, {0, 0}, 0, 2);
  add_cells(cells, {0, 0}, 4, 7);
  add_cells(cells, {0, 0}, 12, 13);
  const auto found = supports(cells, all_of(cells), {0, 0}, kRules);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].t0, 0, 0.05);
  EXPECT_NEAR(found[0].t1, 7, 0.05);
  EXPECT_NEAR(found[1].t0, 12, 0.05);
}

TEST(Supports, ASpeckDoesNotProlongAWall) {
  WallCells cells;
  add_cells(cells, {0, 0}, 0, 4);
  add_cells(cells, {0, 0}, 5.5, 5.6);
  const auto found = supports(cells, all_of(cells), {0, 0}, kRules);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].t1, 4, 0.05);
}

TEST(Quality, UncertaintyOfAnglesFallsWithLength) {
  WallCells brief, lasting;
  add_cells(brief, {0, 0}, 0, 1, 0.01);
  add_cells(lasting, {0, 0}, 0, 8, 0.01);
  const FitQuality a = quality(brief, all_of(brief), {0, 0});
  const FitQuality b = quality(lasting, all_of(lasting), {0, 0});
  EXPECT_NEAR(a.rms_m, 0.01 / std::sqrt(3.0), 0.002);
  EXPECT_GT(a.sigma_angle_rad, 10 * b.sigma_angle_rad);
  EXPECT_GT(a.sigma_offset_m, 2 * b.sigma_offset_m);
}

}  // namespace
}  // namespace roomcut::detect_lines

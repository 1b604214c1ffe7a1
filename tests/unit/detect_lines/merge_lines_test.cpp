// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/merge_lines.h"

#include <gtest/gtest.h>

#include "tests/unit/detect_lines/cells_on_a_line.h"

namespace roomcut::detect_lines {
using namespace roomcut::testing;

namespace {

using testing::add_cells;
using testing::kRules;

const MergeRules kMerge{0.04, 0.03};

LineCandidate candidate(WallCells& cells, const Line2& line, double t0, double t1) {
  const auto first = static_cast<std::uint32_t>(cells.size());
  add_cells(cells, line, t0, t1);
  LineCandidate result{line, {t0, t1, t1 - t0, {}}};
  for (std::uint32_t i = first; i < cells.size(); ++i) result.support.cells.push_back(i);
  return result;
}

std::vector<LineCandidate> merged_pair(const Line2& a, double a0, double a1, const Line2& b, double b0,
                                       double b1) {
  WallCells cells;
  const LineCandidate first = candidate(cells, a, a0, a1);
  const LineCandidate second = candidate(cells, b, b0, b1);
  return merge_near_duplicates(cells, {second, first}, kMerge, kRules);
}

TEST(MergeLines, ADoubledLineBecomesTheStrongerOne) {
  const auto kept = merged_pair({0.4, 5}, 0, 6, {0.41, 5.01}, 1, 3);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].line.d, 5);
  EXPECT_NEAR(kept[0].support.support_m, 6, 0.1);
}

TEST(MergeLines, TheStrongerLineTakesOverTheExtent) {
  const auto kept = merged_pair({0.4, 5}, 0, 6, {0.4, 5.02}, 5, 9);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_NEAR(kept[0].support.t1, 9, 0.01);
  EXPECT_NEAR(kept[0].support.support_m, 9, 0.2);
}

TEST(MergeLines, DistancesAreTakenAtTheSupportNotAtTheOrigin) {
  // 1 degree apart and equal d, but 50 m away from the origin: 87 cm between them.
  EXPECT_EQ(merged_pair({0.4, 5}, 50, 56, {0.4 + 0.0175, 5}, 50, 56).size(), 2U);
}

TEST(MergeLines, AShortLineBesideALongOneIsJoinedFromFartherOff) {
  EXPECT_EQ(merged_pair({0.4, 5}, 0, 6, {0.4, 5.05}, 2, 3).size(), 1U);
  EXPECT_EQ(merged_pair({0.4, 5}, 0, 6, {0.4, 5.05}, 2, 5).size(), 2U);
  EXPECT_EQ(merged_pair({0.4, 5}, 0, 6, {0.4, 5.07}, 2, 3).size(), 2U);
}

TEST(MergeLines, AShortWallOfAnotherStoreyStaysALine) {
  WallCells cells;
  const LineCandidate lower = candidate(cells, {0.4, 5}, 0, 6);
  const std::size_t first = cells.size();
  const LineCandidate upper = candidate(cells, {0.4, 5.05}, 2, 3);
  std::fill(cells.slice.begin() + static_cast<std::ptrdiff_t>(first), cells.slice.end(), 1);
  EXPECT_EQ(merge_near_duplicates(cells, {upper, lower}, kMerge, kRules).size(), 2U);
}

TEST(MergeLines, TheFacesOfAThinWallStayTwo) {
  EXPECT_EQ(merged_pair({0.4, 5}, 0, 6, {0.4, 5.06}, 0, 6).size(), 2U);
}

TEST(MergeLines, CollinearSupportsFarApartStayTwo) {
  EXPECT_EQ(merged_pair({0.4, 5}, 0, 6, {0.4, 5}, 12, 16).size(), 2U);
}

TEST(MergeLines, CrossingLinesStayTwo) {
  EXPECT_EQ(merged_pair({0.4, 5}, 0, 6, {0.5, 5}, 0, 6).size(), 2U);
}

TEST(MergeLines, LinesOnBothSidesOfAngleZeroAreRecognised) {
  EXPECT_EQ(merged_pair({0.001, 5}, 0, 6, {std::numbers::pi - 0.001, -5}, -6, 0).size(), 1U);
}

}  // namespace
}  // namespace roomcut::detect_lines

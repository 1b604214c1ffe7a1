// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/merge_lines.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/unit/refine_lines/made_points.h"

namespace roomcut::refine_lines {
using namespace roomcut::testing;

namespace {

using testing::kDeg;
using testing::whole_line;

constexpr double kDistance_m = 0.015;
constexpr double kAngle_rad = 0.6 * kDeg;

/// Lines along x at height y from x0 to x1; the empty side is up (+1) or down (-1).
class MergeLines : public ::testing::Test {
 protected:
  void add(double y, double x0, double x1, int side, double turn = 0) {
    const Line2 line = posed({std::numbers::pi / 2, y}, {(x0 + x1) / 2, y}, {turn, 0});
    const double a = line.along({x0, y});
    const double b = line.along({x1, y});
    faces_.push_back(std::make_unique<LineFaces>(
        whole_line(line, std::min(a, b), std::max(a, b), static_cast<std::int8_t>(side))));
    candidates_.push_back({line,
                           {(x0 + x1) / 2, y},
                           0.0005,
                           faces_.back().get(),
                           false,
                           faces_.back()->area_m2,
                           "w" + std::to_string(candidates_.size())});
  }
  std::vector<std::size_t> merged() const { return find_merges(candidates_, kDistance_m, kAngle_rad); }

  std::vector<std::unique_ptr<LineFaces>> faces_;
  std::vector<MergeCandidate> candidates_;
};

using Into = std::vector<std::size_t>;

TEST_F(MergeLines, TwoLinesOnOneFaceBecomeTheLongerOne) {
  add(0.01, 0, 3, 1);
  add(0, 0, 8, 1);
  EXPECT_EQ(merged(), (Into{1, 1}));
}

TEST_F(MergeLines, FacesOfAThinWallOfSixCentimetresStay) {
  add(0, 0, 8, -1);
  add(0.06, 0, 8, 1);
  EXPECT_EQ(merged(), (Into{0, 1}));
}

TEST_F(MergeLines, FacesOfAnEvenThinnerSheetStayWhereverSolidIsBetween) {
  add(0, 0, 8, -1);
  add(0.01, 0, 8, 1);
  EXPECT_EQ(merged(), (Into{0, 1}));
}

TEST_F(MergeLines, ASlitOfAirOfOneCentimetreCloses) {
  add(0, 0, 8, 1);
  add(0.01, 0, 7, -1);
  EXPECT_EQ(merged(), (Into{0, 0}));
}

TEST_F(MergeLines, NeitherDistantNorTurnedLinesMerge) {
  add(0, 0, 8, 1);
  add(0.016, 0, 4, 1);
  add(0, 0, 4, 1, 0.7 * kDeg);
  EXPECT_EQ(merged(), (Into{0, 1, 2}));
}

TEST_F(MergeLines, CollinearLinesMergeWithinAMetreOnly) {
  add(0, 0, 5, 1);
  add(0, 5.9, 8, 1);
  add(0, 10.5, 11.5, 1);
  EXPECT_EQ(merged(), (Into{0, 0, 2}));
}

TEST_F(MergeLines, WithoutACommonPlaceAMeasurableStepStays) {
  add(0, 0, 5, 1);
  add(0.01, 5.5, 8, 1);
  EXPECT_EQ(merged(), (Into{0, 1}));
  candidates_[1].sigma_m = 0.004;  // now the step is not significant
  EXPECT_EQ(merged(), (Into{0, 0}));
}

TEST_F(MergeLines, AUsersLineIsNeverMergedAwayButTakesOthersIn) {
  add(0, 0, 8, 1);
  add(0.01, 0, 3, 1);
  candidates_[1].users = true;
  EXPECT_EQ(merged(), (Into{1, 1}));
}

}  // namespace
}  // namespace roomcut::refine_lines

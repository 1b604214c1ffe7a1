// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/hough.h"

#include <gtest/gtest.h>

namespace roomcut {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Votes of a wall of 4 m in pieces of 4 cm, each with an angle that is 2 degrees off, alternating.
void vote_wall(HoughAccumulator& votes, const Line2& line, int sign) {
  for (int i = 0; i < 100; ++i) {
    const double theta = normalised(line.theta + (i % 2 == 0 ? 2 : -2) * kDegree, 0).theta;
    votes.vote(line.at(10 + 0.04 * i), theta, 4 * kDegree, 0.04, sign);
  }
}

TEST(Hough, ThePeakIsTheLineThoughEveryLocalAngleIsWrong) {
  for (const double theta : {0.0, 0.01, 0.7, 1.6, 3.13}) {
    const Line2 line{theta, 3.3};
    HoughAccumulator votes({2, 1}, 20, 0.25 * kDegree, 0.01);
    vote_wall(votes, line, +1);
    const HoughAccumulator::Peak peak = votes.peak();
    EXPECT_LT(angle_between(peak.line.theta, theta), 0.3 * kDegree);
    EXPECT_LT(std::abs(peak.line.distance(line.at(12))), 0.015);
    EXPECT_NEAR(peak.votes_m, 4, 1);
  }
}

TEST(Hough, VotesTakenBackLeaveNothing) {
  HoughAccumulator votes({0, 0}, 20, 0.25 * kDegree, 0.01);
  vote_wall(votes, {0.4, 2}, +1);
  vote_wall(votes, {0.4, 2}, -1);
  EXPECT_EQ(votes.peak().votes_m, 0);
}

TEST(Hough, ASuppressedBinIsNoPeakAgain) {
  HoughAccumulator votes({0, 0}, 20, 0.25 * kDegree, 0.01);
  vote_wall(votes, {0.4, 2}, +1);
  const HoughAccumulator::Peak first = votes.peak();
  votes.suppress(first);
  const HoughAccumulator::Peak second = votes.peak();
  EXPECT_NE(std::pair(first.angle, first.distance), std::pair(second.angle, second.distance));
  EXPECT_LE(second.votes_m, first.votes_m);
}

TEST(Hough, PointsOutsideTheRadiusDoNoHarm) {
  HoughAccumulator votes({0, 0}, 1, 0.25 * kDegree, 0.01);
  votes.vote({500, -500}, 0.3, 4 * kDegree, 0.04, +1);
  EXPECT_LE(votes.peak().votes_m, 0.04);
}

}  // namespace
}  // namespace roomcut

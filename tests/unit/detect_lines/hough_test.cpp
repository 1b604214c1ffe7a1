// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/hough.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace roomcut::detect_lines {
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

TEST(Hough, ThePeakIsThatOfTheVotesThatAreLeft) {
  const auto wall = [](int i) { return Line2{0.37 * i - std::floor(0.37 * i / 3.1) * 3.1, 190.0 - 5 * i}; };
  HoughAccumulator votes({0, 0}, 200, 0.25 * kDegree, 0.01);
  for (int i = 0; i < 40; ++i) vote_wall(votes, wall(i), +1);
  for (int taken = 0; taken < 40; ++taken) {
    HoughAccumulator left({0, 0}, 200, 0.25 * kDegree, 0.01);
    for (int i = taken; i < 40; ++i) vote_wall(left, wall(i), +1);
    const HoughAccumulator::Peak peak = votes.peak();
    const HoughAccumulator::Peak expected = left.peak();
    ASSERT_EQ(std::tie(peak.angle, peak.distance, peak.votes_m),
              std::tie(expected.angle, expected.distance, expected.votes_m));
    vote_wall(votes, wall(taken), -1);
  }
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
}  // namespace roomcut::detect_lines

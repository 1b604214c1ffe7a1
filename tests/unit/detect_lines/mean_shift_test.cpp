// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/mean_shift.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random/counter_random.h"

namespace roomcut::detect_lines {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr Bandwidth kBandwidth{0.85 * kDegree, 0.01};

/// Votes of a wall in pieces of 4 cm whose directions are up to half a degree off.
void vote_wall(HoughAccumulator& votes, const Line2& line, double t0, double t1) {
  const auto pieces = static_cast<std::uint64_t>((t1 - t0) / 0.04);
  for (std::uint64_t i = 0; i < pieces; ++i) {
    const double off = (random_unit(3, 7, i) - 0.5) * kDegree;
    votes.vote(line.at(t0 + 0.04 * (static_cast<double>(i) + 0.5)), normalised(line.theta + off, 0).theta, 0,
               0.04, +1);
  }
}

HoughAccumulator accumulator() {
  return {{1, 2}, 12, 0.25 * kDegree, 0.01};
}

TEST(MeanShift, TheStrongestModeIsTheWallWhateverItsDirection) {
  for (const double theta : {0.0, 0.002, 0.7, 1.6, 3.14}) {
    const Line2 wall{theta, 3.3};
    HoughAccumulator votes = accumulator();
    const double middle = wall.along({1, 2});
    vote_wall(votes, wall, middle - 2, middle + 2);
    const std::vector<HoughMode> modes = hough_modes(votes, kBandwidth, 1);
    ASSERT_FALSE(modes.empty()) << theta;
    EXPECT_LT(angle_between(modes.front().line.theta, theta), 0.2 * kDegree) << theta;
    EXPECT_LT(std::abs(modes.front().line.distance(wall.at(middle))), 0.01) << theta;
    EXPECT_EQ(modes.size(), 1U) << theta;
  }
}

TEST(MeanShift, TheFacesOfAThinWallAreTwoModesAndNearerLinesAreOne) {
  const auto modes = [](double apart) {
    HoughAccumulator votes = accumulator();
    vote_wall(votes, {0.4, 2}, -2, 2);
    vote_wall(votes, {0.4, 2 + apart}, -2, 2);
    return hough_modes(votes, kBandwidth, 2).size();
  };
  EXPECT_EQ(modes(0.06), 2U);
  EXPECT_EQ(modes(0.01), 1U);
}

TEST(MeanShift, WeakModesAreLeftOutAndTheStrongestComesFirst) {
  HoughAccumulator votes = accumulator();
  vote_wall(votes, {0.4, 2}, -1, 0);
  vote_wall(votes, {1.4, 4}, -2, 2);
  const std::vector<HoughMode> modes = hough_modes(votes, kBandwidth, 0.5);
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_GT(modes[0].votes_m, modes[1].votes_m);
  EXPECT_EQ(hough_modes(votes, kBandwidth, 2).size(), 1U);
}

TEST(MeanShift, AnEmptyAccumulatorHasNoMode) {
  EXPECT_TRUE(hough_modes(accumulator(), kBandwidth, 0.5).empty());
}

}  // namespace
}  // namespace roomcut::detect_lines

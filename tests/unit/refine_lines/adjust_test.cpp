// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/adjust.h"

#include <gtest/gtest.h>

#include "tests/unit/refine_lines/made_points.h"

namespace roomcut::refine_lines {
namespace {

using testing::kDeg;
using testing::Normal;

TEST(LineResidual, ItsDerivativesAreThoseOfItsValue) {
  Normal random(21);
  for (int i = 0; i < 50; ++i) {
    const LineResidual residual{random.uniform(-0.1, 0.1), random.uniform(-8, 8),
                                random.uniform(0.0005, 0.01)};
    const Pose pose{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
    constexpr double kStep = 1e-6;
    const double by_turn =
        (residual.value({pose.turn + kStep, pose.shift}) - residual.value({pose.turn - kStep, pose.shift})) /
        (2 * kStep);
    const double by_shift =
        (residual.value({pose.turn, pose.shift + kStep}) - residual.value({pose.turn, pose.shift - kStep})) /
        (2 * kStep);
    EXPECT_NEAR(residual.by_turn(pose), by_turn, 1e-5 * (1 + std::abs(by_turn)));
    EXPECT_NEAR(residual.by_shift(), by_shift, 1e-5 * std::abs(by_shift));
  }
}

TEST(LineResidual, IsZeroForPointsOnThePosedLine) {
  const Line2 line = normalised(1.1, 2.0);
  const Vec2 centre(3, -1);
  const Pose pose{0.02, 0.03};
  const Line2 there = posed(line, centre, pose);
  for (const double t : {-4.0, 0.0, 2.5}) {
    const Vec2 p = there.at(t) - centre;
    const LineResidual residual{line.normal().dot(p), line.direction().dot(p), 0.001};
    EXPECT_NEAR(residual.value(pose), 0, 1e-9);
  }
}

/// A line along direction theta + 90 deg with `count` observations, its true direction `off` away from theta.
LineProblem made_line(Normal& random, double theta, double off, int count, double sigma) {
  const Line2 line = normalised(theta, 1.0);
  const Line2 truth = posed(line, line.at(0.05 * count), {off, 0});
  std::vector<Observation> observations;
  for (int i = 0; i < count; ++i) {
    const Vec2 p = truth.at(truth.along(line.at(0.1 * i))) + random(sigma) * truth.normal();
    observations.push_back({p, sigma * sigma, sigma * sigma, 50, 0});
  }
  return make_problem(line, line.at(0.05 * count), observations, {0.06, 2 * kDeg});
}

Adjustment adjusted(std::vector<LineProblem> lines, double regularity) {
  Adjustment a;
  a.lines = std::move(lines);
  std::vector<Direction> directions;
  for (std::size_t i = 0; i < a.lines.size(); ++i) {
    const LineFit fit = fit_line(a.lines[i]);
    a.poses.push_back(fit.pose);
    a.constant.push_back(false);
    directions.push_back({"w" + std::to_string(i), a.lines[i].line.theta + fit.pose.turn,
                          std::sqrt(fit.covariance.turn_turn), true});
  }
  a.classes = find_angle_classes(directions);
  a.regularity_rad = regularity;
  EXPECT_TRUE(adjust(a));
  return a;
}

TEST(Adjust, WithoutClassesCeresFindsTheSingleFit) {
  Normal random(22);
  LineProblem line = made_line(random, 0.4, 0.003, 40, 0.002);
  LineProblem copy = line;
  const LineFit fit = fit_line(copy);
  const Adjustment a = adjusted({line}, 0);
  EXPECT_NEAR(a.poses[0].turn, fit.pose.turn, 1e-7);
  EXPECT_NEAR(a.poses[0].shift, fit.pose.shift, 1e-7);
}

TEST(Adjust, AnObliqueWallAtTwoDegreesIsNotPulled) {
  Normal random(23);
  const Adjustment a = adjusted(
      {made_line(random, 0, 0, 60, 0.001), made_line(random, 0, 0, 60, 0.001),
       made_line(random, std::numbers::pi / 2, 0, 60, 0.001), made_line(random, 0, 2 * kDeg, 20, 0.002)},
      0.1 * kDeg);
  EXPECT_EQ(a.classes.class_of[3], -1);
  EXPECT_NEAR(a.poses[3].turn, 2 * kDeg, 0.2 * kDeg);
}

TEST(Adjust, AMeasurablyObliqueWallAtHalfADegreeIsNotPulledEither) {
  Normal random(24);
  const Adjustment a = adjusted({made_line(random, 0, 0, 60, 0.001), made_line(random, 0, 0, 60, 0.001),
                                 made_line(random, 0, 0.5 * kDeg, 40, 0.001)},
                                0.1 * kDeg);
  EXPECT_EQ(a.classes.class_of[2], -1);
  EXPECT_NEAR(a.poses[2].turn, 0.5 * kDeg, 0.05 * kDeg);
}

TEST(Adjust, AVagueShortWallTakesTheDirectionOfTheOthersAndKeepsItsOffset) {
  // Forty short walls: alone their directions scatter, with the class they do so far less.
  double alone = 0;
  double together = 0;
  double apart = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Normal random(100 + seed);
    const LineProblem long_one = made_line(random, 0, 0, 80, 0.001);
    const LineProblem other = made_line(random, std::numbers::pi / 2, 0, 80, 0.001);
    const LineProblem vague = made_line(random, 0, 0, 5, 0.003);
    const Adjustment free = adjusted({long_one, other, vague}, 0);
    const Adjustment regular = adjusted({long_one, other, vague}, 0.1 * kDeg);
    alone += free.poses[2].turn * free.poses[2].turn;
    together += regular.poses[2].turn * regular.poses[2].turn;
    apart += std::pow(regular.poses[2].shift - free.poses[2].shift, 2);
  }
  EXPECT_LT(std::sqrt(apart / 40), 0.0005);
  EXPECT_LT(together, 0.25 * alone);
}

TEST(Adjust, AConstantLineIsNotTouched) {
  Normal random(25);
  Adjustment a;
  a.lines = {made_line(random, 0, 0.01, 40, 0.001)};
  a.poses = {unmoved(a.lines[0])};
  a.constant = {true};
  const Pose before = a.poses[0];
  EXPECT_TRUE(adjust(a));
  EXPECT_EQ(a.poses[0].turn, before.turn);
  EXPECT_EQ(a.poses[0].shift, before.shift);
}

}  // namespace
}  // namespace roomcut::refine_lines

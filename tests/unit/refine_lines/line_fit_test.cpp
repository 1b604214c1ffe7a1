// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/line_fit.h"

#include <gtest/gtest.h>

#include "tests/unit/refine_lines/made_points.h"

namespace roomcut::refine_lines {
using namespace roomcut::testing;

namespace {

using testing::add_wall;
using testing::kDeg;
using testing::Normal;
using testing::whole_line;

const std::vector<double> kLevels{0, 2.5};
const LinePrior kLoose{0.06, 2 * kDeg};

/// The error of one simulated wall at its centre, and the standard deviation that the fit states.
struct Trial {
  double offset_error, offset_sigma, angle_error, angle_sigma;
};

/// A wall of 1 … 8 m anywhere; the line begins up to 1.5 cm and 0.3 degrees off.
Trial simulate(Normal& random, double noise, double per_m2) {
  const Line2 truth = normalised(random.uniform(0, 3.14), random.uniform(-10, 10));
  const double length = random.uniform(1, 8);
  const double t0 = random.uniform(-10, 10);
  const double turn = random.uniform(-0.3, 0.3) * kDeg;
  const Vec2 middle = truth.at(t0 + length / 2) + random.uniform(-0.015, 0.015) * truth.normal();
  const Line2 start = posed(truth, middle, {turn, 0});
  const double centre = start.along(middle);
  const std::vector<LineFaces> lines{whole_line(start, centre - length / 2, centre + length / 2)};
  CloudTile tile;
  add_wall(tile, random, truth, t0, t0 + length, per_m2, noise);
  const double band = std::max(0.06, 5 * noise);
  LineObserver observer(lines, {true}, kLevels, band, noise, 500);
  observer.add(tile);
  LineProblem problem = make_problem(start, middle, observer.observations(0), kLoose);
  const LineFit fit = fit_line(problem);
  const Line2 found = posed(start, problem.centre, fit.pose);
  // Both normals point the same way within the start's error; near 0 and pi they may be turned.
  const double sign = found.normal().dot(truth.normal()) > 0 ? 1 : -1;
  const Vec2 at = problem.centre;
  return {sign * (truth.distance(at) * sign - found.distance(at)), std::sqrt(fit.covariance.shift_shift),
          std::remainder(found.theta - truth.theta, std::numbers::pi), std::sqrt(fit.covariance.turn_turn)};
}

TEST(LineFit, OffsetsAreUnbiasedForEveryNoise) {
  for (const double noise : {0.003, 0.005, 0.01, 0.02}) {
    Normal random(11);
    double sum = 0;
    constexpr int kLines = 100;
    for (int i = 0; i < kLines; ++i) {
      sum += simulate(random, noise, 100).offset_error;
    }
    EXPECT_LT(std::abs(sum / kLines), 3e-4) << "noise " << noise;
  }
}

TEST(LineFit, NinetyFivePercentIntervalsHoldForOffsetAndAngle) {
  constexpr int kLines = 700;
  for (const double noise : {0.003, 0.01}) {
    Normal random(12);
    int offsets = 0;
    int angles = 0;
    for (int i = 0; i < kLines; ++i) {
      const Trial trial = simulate(random, noise, 60);
      offsets += std::abs(trial.offset_error) < 1.96 * trial.offset_sigma ? 1 : 0;
      angles += std::abs(trial.angle_error) < 1.96 * trial.angle_sigma ? 1 : 0;
    }
    RecordProperty("offsets", offsets);
    EXPECT_GE(offsets, 0.93 * kLines) << "noise " << noise;
    EXPECT_LE(offsets, 0.97 * kLines) << "noise " << noise;
    EXPECT_GE(angles, 0.93 * kLines) << "noise " << noise;
    EXPECT_LE(angles, 0.975 * kLines) << "noise " << noise;
  }
}

TEST(LineFit, ALeaningWallIsTakenAtHalfHeightAndIsUncertain) {
  // 3 cm out of plumb over 2.5 m, seen with 1 mm of noise.
  const Line2 line{0, 2.0};
  const std::vector<LineFaces> lines{whole_line(line, 0, 4)};
  Normal random(14);
  CloudTile tile;
  add_wall(tile, random, line, 0, 4, 500, 0.001);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    tile.x[i] += 0.012F * (tile.z[i] - 1.25F);
  }
  LineObserver observer(lines, {true}, kLevels, 0.06, 0.001, 500);
  observer.add(tile);
  LineProblem problem = make_problem(line, {2, 2}, observer.observations(0), kLoose);
  const LineFit fit = fit_line(problem);
  EXPECT_NEAR(fit.pose.shift - unmoved(problem).shift, 0, 0.001);
  EXPECT_GT(std::sqrt(fit.covariance.shift_shift), 0.001);
}

TEST(LineFit, FurnitureBeforeTheLowerFifthDoesNotPull) {
  const Line2 line{0, 2.0};
  const std::vector<LineFaces> lines{whole_line(line, 0, 4)};
  Normal random(15);
  CloudTile tile;
  add_wall(tile, random, line, 0, 4, 500, 0.004);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    tile.x[i] += tile.z[i] < 0.5F ? 0.04F : 0.0F;
  }
  LineObserver observer(lines, {true}, kLevels, 0.06, 0.004, 500);
  observer.add(tile);
  LineProblem problem = make_problem(line, {2, 2}, observer.observations(0), kLoose);
  EXPECT_NEAR(fit_line(problem).pose.shift - unmoved(problem).shift, 0, 0.0006);
}

TEST(LineFit, ALineHalfHiddenByACurtainDoesNotLieAcross) {
  std::vector<Observation> observations;
  Normal random(16);
  for (int zone = 0; zone < 5; ++zone) {
    for (int i = 0; i < 16; ++i) {
      const double offset = (i < 8 ? 0.0 : 0.045) + random(0.002);
      observations.push_back({{0.1 * i, offset}, 1e-6, 1e-6, 30, zone});
    }
  }
  LineProblem problem = make_problem({std::numbers::pi / 2, 0}, {0.8, 0}, observations, {0.06, 0.5 * kDeg});
  EXPECT_LT(std::abs(fit_line(problem).pose.turn), 0.35 * kDeg);
}

/// Observations every 10 cm of a line along x with the given offsets.
std::vector<Observation> observed(const std::vector<double>& offsets, double sigma) {
  std::vector<Observation> result;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    result.push_back({{0.1 * static_cast<double>(i), offsets[i]}, sigma * sigma, sigma * sigma, 50, 0});
  }
  return result;
}

TEST(LineFit, AWavyWallIsLessCertainThanItsNoiseSays) {
  // Unevenness of 3 mm that lasts for 50 cm: five neighbouring observations share it.
  Normal random(13);
  int inside = 0;
  constexpr int kLines = 400;
  for (int k = 0; k < kLines; ++k) {
    std::vector<double> offsets;
    double wave = 0;
    for (int i = 0; i < 80; ++i) {
      wave = i % 5 == 0 ? random(0.003) : wave;
      offsets.push_back(wave + random(0.0005));
    }
    LineProblem problem = make_problem({std::numbers::pi / 2, 0}, {4, 0}, observed(offsets, 0.0005), kLoose);
    const LineFit fit = fit_line(problem);
    const double error = posed(problem.line, problem.centre, fit.pose).distance(problem.centre);
    inside += std::abs(error) < 1.96 * std::sqrt(fit.covariance.shift_shift) ? 1 : 0;
    if (k == 0) {
      EXPECT_GT(fit.unevenness_m, 0.0015);
    }
  }
  EXPECT_GE(inside, 0.90 * kLines);
}

TEST(LineFit, AFifthOfWrongObservationsIsOutvoted) {
  std::vector<double> offsets(50, 0.0);
  for (std::size_t i = 20; i < 30; ++i) {
    offsets[i] = 0.04;
  }
  LineProblem problem = make_problem({std::numbers::pi / 2, 0}, {2.5, 0}, observed(offsets, 0.001), kLoose);
  const LineFit fit = fit_line(problem);
  EXPECT_NEAR(posed(problem.line, problem.centre, fit.pose).distance({2.5, 0}), 0, 0.0005);
}

TEST(LineFit, WithoutObservationsTheLineStaysAndIsAsUncertainAsItsPrior) {
  const Line2 line = normalised(0.3, 2);
  LineProblem problem = make_problem(line, line.at(1) + 0.01 * line.normal(), {}, kLoose);
  const LineFit fit = fit_line(problem);
  const Line2 same = posed(line, problem.centre, fit.pose);
  EXPECT_NEAR(same.theta, line.theta, 1e-12);
  EXPECT_NEAR(same.d, line.d, 1e-12);
  EXPECT_NEAR(std::sqrt(fit.covariance.shift_shift), kLoose.shift_m, 1e-9);
}

}  // namespace
}  // namespace roomcut::refine_lines

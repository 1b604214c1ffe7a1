// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/model_choice.h"

#include <gtest/gtest.h>

#include "tests/unit/fit_surfaces/made_floors.h"

namespace roomcut::fit_surfaces {
namespace {

using roomcut::testing::made_samples;
using roomcut::testing::Normal;

const Vec2 kMiddle(3, 2.5);
const std::vector<Vec2> kOutline = {{0, 0}, {6, 0}, {6, 5}, {0, 5}};

PlaneFit fit_room(const std::vector<Sample>& samples, const Roughness& roughness = {}) {
  return choose_surface(samples, fit_both(samples, kMiddle), kOutline, roughness, true);
}

TEST(ModelChoice, LevelFloorsAreNeverTiltedByNoise) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Normal random(seed);
    EXPECT_EQ(fit_room(made_samples(random, 12, 10, 0.001, [](const Vec2&) { return 0.0; })).gradient,
              Vec2(0, 0))
        << seed;
  }
}

TEST(ModelChoice, ATiltOfAMillimetreAMetreIsFound) {
  Normal random(1);
  const PlaneFit fit =
      fit_room(made_samples(random, 12, 10, 0.0005, [](const Vec2& p) { return 1 + 0.001 * p.x(); }));
  EXPECT_NEAR(fit.gradient.x(), 0.001, 0.0001);
  EXPECT_NEAR(fit.z, 1.003, 0.0003);
}

TEST(ModelChoice, ACarpetOverHalfAFloorTiltsNothing) {
  Normal random(2);
  const auto samples =
      made_samples(random, 12, 10, 0.0005, [](const Vec2& p) { return p.x() > 3.6 ? 0.018 : 0.0; });
  const PlaneFit fit = fit_room(samples);
  EXPECT_EQ(fit.gradient, Vec2(0, 0));
  EXPECT_NEAR(fit.z, 0, 0.0003);
}

TEST(ModelChoice, WhatWasSeenInACornerIsNotContinuedOverTheHall) {
  Normal random(3);
  const auto samples = made_samples(random, 12, 10, 0.0005, [](const Vec2& p) { return 0.004 * p.x(); });
  EXPECT_GT(fit_room(samples).gradient.norm(), 0.0035);
  const std::vector<Vec2> hall = {{0, 0}, {40, 0}, {40, 20}, {0, 20}};
  EXPECT_EQ(choose_surface(samples, fit_both(samples, {20, 10}), hall, {}, true).gradient, Vec2(0, 0));
}

TEST(ModelChoice, TiltsThatAWarpedScanHasEverywhereAreNoTilts) {
  Normal random(4);
  const auto samples =
      made_samples(random, 8, 8, 0.001, [](const Vec2& p) { return 0.01 * std::sin(p.x() / 3); });
  const std::vector<Vec2> room = {{0, 0}, {4, 4}};
  EXPECT_GT(choose_surface(samples, fit_both(samples, {2, 2}), room, {}, true).gradient.norm(), 0);
  const PlaneFit warped = choose_surface(samples, fit_both(samples, {2, 2}), room, {0.01 * 0.01, 25}, true);
  EXPECT_EQ(warped.gradient, Vec2(0, 0));
  EXPECT_GT(std::sqrt(warped.covariance(0, 0)), 0.004);
}

TEST(ModelChoice, TheStatedSigmaCoversTheErrorWhereNeighboursErrAlike) {
  int inside = 0;
  constexpr int kFloors = 300;
  for (std::uint64_t seed = 1; seed <= kFloors; ++seed) {
    Normal random(seed);
    // Errors of 2 mm that 2 × 2 patches of the 20 × 20 have in common.
    double block[100];
    for (double& error : block) {
      error = random(0.002);
    }
    const auto samples = made_samples(random, 20, 20, 0.0005, [&](const Vec2& p) {
      return block[static_cast<int>(p.y()) * 10 + static_cast<int>(p.x())];
    });
    PlaneFit fit = fit_level(samples, {5, 5});
    measure_covariance(samples, {}, fit);
    inside += std::abs(fit.z) < 1.96 * std::sqrt(fit.covariance(0, 0)) ? 1 : 0;
  }
  EXPECT_GE(inside, 0.93 * kFloors);
  EXPECT_LT(inside, kFloors) << "a sigma that covers everything says nothing";
}

}  // namespace
}  // namespace roomcut::fit_surfaces

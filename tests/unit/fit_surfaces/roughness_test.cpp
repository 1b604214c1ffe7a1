// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/roughness.h"

#include <gtest/gtest.h>

#include "tests/unit/fit_surfaces/made_floors.h"

namespace roomcut::fit_surfaces {
namespace {

using roomcut::testing::made_samples;
using roomcut::testing::Normal;

RoughRegion region_of(std::vector<Sample> samples) {
  RoughRegion region;
  region.level = fit_level(samples, {2, 2}, {});
  region.tilted = fit_tilted(samples, {2, 2}, {}, Vec2(0, 0));
  region.samples = std::move(samples);
  return region;
}

/// A smooth random surface of standard deviation 1 whose covariance falls as a Gaussian of 1 m.
std::function<double(const Vec2&)> warp(Normal& random) {
  struct Wave {
    Vec2 k;
    double phase;
  };
  std::vector<Wave> waves;
  for (int i = 0; i < 60; ++i) {
    waves.push_back({Vec2(random(1.0), random(1.0)), random.uniform(0, 6.2832)});
  }
  return [waves](const Vec2& p) {
    double sum = 0;
    for (const Wave& wave : waves) {
      sum += std::cos(wave.k.dot(p) + wave.phase);
    }
    return sum * std::sqrt(2.0 / 60);
  };
}

TEST(Roughness, PatchesThatErrAloneErrAlone) {
  std::vector<RoughRegion> regions;
  Normal random(1);
  for (int i = 0; i < 10; ++i) {
    regions.push_back(region_of(made_samples(random, 8, 8, 0.002, [](const Vec2&) { return 0.0; })));
  }
  const Roughness roughness = measure_roughness(regions, 0.5);
  EXPECT_LT(std::sqrt(roughness.variance_m2), 0.0006);
  EXPECT_LT(roughness.patches, 1.5);
}

TEST(Roughness, AWarpOfTwoCentimetresIsMeasuredInRoomsHardlyLargerThanIt) {
  std::vector<RoughRegion> regions;
  Normal random(2);
  for (int i = 0; i < 30; ++i) {
    const auto shape = warp(random);
    regions.push_back(
        region_of(made_samples(random, 9, 8, 0.001, [&](const Vec2& p) { return 0.02 * shape(p); })));
  }
  const Roughness roughness = measure_roughness(regions, 0.5);
  EXPECT_GT(std::sqrt(roughness.variance_m2), 0.012);
  EXPECT_LT(std::sqrt(roughness.variance_m2), 0.028);
  EXPECT_GT(roughness.patches, 10) << "2 pi m² are 25";
  EXPECT_LT(roughness.patches, 50);
}

TEST(Roughness, AFloorThatFallsEvenlyIsNotRough) {
  Normal random(3);
  std::vector<RoughRegion> regions;
  for (int i = 0; i < 3; ++i) {
    regions.push_back(
        region_of(made_samples(random, 30, 16, 0.001, [](const Vec2& p) { return 0.01 * p.x(); })));
  }
  EXPECT_LT(std::sqrt(measure_roughness(regions, 0.5).variance_m2), 0.002);
}

}  // namespace
}  // namespace roomcut::fit_surfaces

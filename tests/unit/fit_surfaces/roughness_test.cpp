// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/roughness.h"

#include <gtest/gtest.h>

#include "tests/unit/fit_surfaces/made_floors.h"

namespace roomcut::fit_surfaces {
namespace {

using roomcut::testing::made_samples;
using roomcut::testing::Normal;

struct Region {
  explicit Region(std::vector<Sample> of) : samples(std::move(of)), fits(fit_both(samples, {2, 2})) {}
  std::vector<Sample> samples;
  Fits fits;
};

Roughness roughness_of(const std::vector<Region>& regions) {
  std::vector<RoughRegion> rough;
  for (const Region& region : regions) {
    rough.push_back({region.samples, &region.fits});
  }
  return measure_roughness(rough, 0.5);
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
  std::vector<Region> regions;
  Normal random(1);
  for (int i = 0; i < 10; ++i) {
    regions.emplace_back(made_samples(random, 8, 8, 0.002, [](const Vec2&) { return 0.0; }));
  }
  const Roughness roughness = roughness_of(regions);
  EXPECT_LT(std::sqrt(roughness.variance_m2), 0.0006);
  EXPECT_LT(roughness.patches, 1.5);
}

TEST(Roughness, AWarpOfTwoCentimetresIsMeasuredInRoomsHardlyLargerThanIt) {
  std::vector<Region> regions;
  Normal random(2);
  for (int i = 0; i < 30; ++i) {
    const auto shape = warp(random);
    regions.emplace_back(made_samples(random, 9, 8, 0.001, [&](const Vec2& p) { return 0.02 * shape(p); }));
  }
  const Roughness roughness = roughness_of(regions);
  EXPECT_GT(std::sqrt(roughness.variance_m2), 0.012);
  EXPECT_LT(std::sqrt(roughness.variance_m2), 0.028);
  EXPECT_GT(roughness.patches, 10) << "2 pi m² are 25";
  EXPECT_LT(roughness.patches, 50);
}

TEST(Roughness, AFloorThatFallsEvenlyIsNotRough) {
  Normal random(3);
  std::vector<Region> regions;
  for (int i = 0; i < 3; ++i) {
    regions.emplace_back(made_samples(random, 30, 16, 0.001, [](const Vec2& p) { return 0.01 * p.x(); }));
  }
  EXPECT_LT(std::sqrt(roughness_of(regions).variance_m2), 0.002);
}

}  // namespace
}  // namespace roomcut::fit_surfaces

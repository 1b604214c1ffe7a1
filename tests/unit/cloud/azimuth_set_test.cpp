// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cloud/azimuth_set.h"

#include <gtest/gtest.h>

#include <cmath>

namespace roomcut {
namespace {

constexpr double kStep_rad = std::numbers::pi / kAzimuthSteps;

TEST(AzimuthSet, HoldsTheStepsWithinTheLimitAndNoOther) {
  for (const double theta : {0.0, 0.3, 1.5, 3.1}) {
    const AzimuthSet set = azimuths_on(theta, kAzimuthFits_rad);
    for (std::size_t step = 0; step < set.size(); ++step) {
      const double azimuth = (static_cast<double>(step) + 0.5) * kStep_rad;
      const double apart = std::abs(azimuth - theta);
      EXPECT_EQ(set[step], std::min(apart, std::numbers::pi - apart) <= kAzimuthFits_rad)
          << theta << ", step " << step;
    }
    EXPECT_NEAR(static_cast<double>(set.count()), 2 * kAzimuthFits_rad / kStep_rad, 1);
  }
}

TEST(AzimuthSet, NormalsHaveNoSign) {
  const AzimuthSet set = azimuths_on(0.01, kAzimuthFits_rad);
  EXPECT_TRUE(set[0]);
  EXPECT_TRUE(set[kAzimuthSteps - 1]);
  EXPECT_FALSE(set[kAzimuthSteps / 2]);
}

}  // namespace
}  // namespace roomcut

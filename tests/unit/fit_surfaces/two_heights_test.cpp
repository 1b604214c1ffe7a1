// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/two_heights.h"

#include <gtest/gtest.h>

#include "stages/fit_surfaces/model_choice.h"
#include "tests/unit/fit_surfaces/made_floors.h"

namespace roomcut::fit_surfaces {
namespace {

using roomcut::testing::made_samples;
using roomcut::testing::Normal;

TEST(TwoHeights, AreFoundWithTheirSamples) {
  Normal random(1);
  const auto samples =
      made_samples(random, 10, 10, 0.001, [](const Vec2& p) { return p.x() < 2 ? 0.01 : 0.0; });
  const auto two = find_two_heights(samples);
  ASSERT_TRUE(two);
  EXPECT_NEAR(two->low, 0, 0.0005);
  EXPECT_NEAR(two->high, 0.01, 0.0005);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(two->is_high[i], samples[i].at.x() < 2);
  }
  EXPECT_TRUE(has_two_heights(samples, fit_both(samples, {2.5, 2.5}), *two));
}

TEST(TwoHeights, ASlopeHasNone) {
  Normal random(2);
  const auto samples = made_samples(random, 20, 10, 0.001, [](const Vec2& p) { return 0.005 * p.x(); });
  const auto two = find_two_heights(samples);
  EXPECT_FALSE(two && has_two_heights(samples, fit_both(samples, {5, 2.5}), *two));
}

TEST(TwoHeights, ALevelFloorHasNone) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Normal random(seed);
    const auto samples = made_samples(random, 12, 10, 0.002, [](const Vec2&) { return 0.0; });
    const auto two = find_two_heights(samples);
    EXPECT_FALSE(two && has_two_heights(samples, fit_both(samples, {3, 2.5}), *two)) << seed;
  }
}

}  // namespace
}  // namespace roomcut::fit_surfaces

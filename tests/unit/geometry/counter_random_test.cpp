// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/random/counter_random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace roomcut {
namespace {

TEST(CounterRandom, IsUniformInMeanVarianceAndTails) {
  constexpr int kCount = 200000;
  double sum = 0, squares = 0, low = 1, high = 0;
  for (int i = 0; i < kCount; ++i) {
    const double u = random_unit(7, 3, i);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
    low = std::min(low, u);
    high = std::max(high, u);
  }
  const double mean = sum / kCount;
  EXPECT_NEAR(mean, 0.5, 5 * std::sqrt(1.0 / 12 / kCount));
  EXPECT_NEAR(squares / kCount - mean * mean, 1.0 / 12, 1e-3);
  EXPECT_LT(low, 1e-4);
  EXPECT_GT(high, 1 - 1e-4);
}

TEST(CounterRandom, NeighbouringSeedsStreamsAndCountersShareNoValue) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (std::uint64_t stream = 0; stream < 20; ++stream) {
      for (std::uint64_t counter = 0; counter < 20; ++counter) {
        seen.insert(random_bits(seed, stream, counter));
      }
    }
  }
  EXPECT_EQ(seen.size(), 8000U);
}

}  // namespace
}  // namespace roomcut

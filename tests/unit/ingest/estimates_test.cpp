// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/estimates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "stages/ingest/ingest.h"

namespace roomcut::ingest {
namespace {

TEST(LogHistogram, has_the_median_within_a_bin) {
  std::mt19937_64 random(11);
  std::lognormal_distribution<double> values(-5, 1.5);
  LogHistogram histogram;
  std::vector<double> all;
  for (int i = 0; i < 20'001; ++i) {
    all.push_back(values(random));
    histogram.add(all.back());
  }
  std::nth_element(all.begin(), all.begin() + 10'000, all.end());
  EXPECT_NEAR(histogram.median() / all[10'000], 1, 0.01);
}

TEST(LogHistogram, counts_weights_and_joins) {
  LogHistogram a;
  LogHistogram b;
  a.add(1.0, 10);
  b.add(100.0, 15);
  a.add(b);
  EXPECT_EQ(a.total(), 25U);
  EXPECT_NEAR(a.median(), 100, 2);
}

TEST(LogHistogram, takes_zero_and_huge_values_into_its_end_bins) {
  LogHistogram histogram;
  histogram.add(0);
  histogram.add(0);
  histogram.add(1e300);
  EXPECT_LT(histogram.median(), 1e-6);
  EXPECT_EQ(LogHistogram().median(), 0);
}

SurfaceEstimates with_noise(const std::vector<std::pair<double, std::uint64_t>>& values) {
  SurfaceEstimates estimates;
  for (const auto& [sigma_m, weight] : values) {
    estimates.noise.add(static_cast<float>(sigma_m), weight);
  }
  return estimates;
}

TEST(Noise, of_a_sparse_scan_is_that_of_the_few_neighbourhoods_of_one_face) {
  EXPECT_NEAR(noise_of(with_noise({{0.005, 10}, {0.06, 60}, {0.09, 30}}), 0), 0.005, 2e-4);
}

TEST(Noise, of_a_noisy_scan_is_not_that_of_its_best_patches) {
  EXPECT_NEAR(noise_of(with_noise({{0.022, 10}, {0.030, 50}, {0.036, 40}}), 0), 0.030, 1e-3);
  EXPECT_NEAR(noise_of(with_noise({{0.005, 1}, {0.06, 99}}), 0), 0.06, 2e-3) << "one in a hundred is chance";
}

}  // namespace
}  // namespace roomcut::ingest

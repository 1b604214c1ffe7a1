// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/robust/robust_offset.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/unit/robust/normal.h"

namespace roomcut {
namespace {

using testing::Normal;

constexpr double kHalf_m = 0.06;
constexpr std::size_t kBins = 50;

class Histogram {
 public:
  void add(double offset) {
    const double position = (offset + kHalf_m) / (2 * kHalf_m) * kBins;
    if (position >= 0 && position < kBins) {
      const auto bin = static_cast<std::size_t>(position);
      bins_[bin] += OffsetHistogram::pack(position - static_cast<double>(bin));
    }
  }
  RobustOffset location(double noise) const { return robust_offset(bins_, kHalf_m, noise); }

 private:
  std::array<std::uint64_t, kBins> bins_{};
};

TEST(RobustOffset, WithoutNoiseItIsExactFarBelowTheBinWidth) {
  for (const double offset : {-0.0123456, 0.0, 0.0004999, 0.0310001}) {
    Histogram histogram;
    for (int i = 0; i < 50; ++i) {
      histogram.add(offset);
    }
    EXPECT_NEAR(histogram.location(0).offset_m, offset, 2e-6);
  }
}

TEST(RobustOffset, ItsVarianceIsTheOneItStates) {
  Normal random(1);
  const double noise = 0.005;
  double squares = 0;
  double stated = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    Histogram histogram;
    for (int i = 0; i < 60; ++i) {
      histogram.add(0.011 + random(noise));
    }
    const RobustOffset found = histogram.location(noise);
    squares += (found.offset_m - 0.011) * (found.offset_m - 0.011);
    stated += found.variance_m2;
  }
  EXPECT_NEAR(squares / stated, 1, 0.12);
}

TEST(RobustOffset, AFrameThatStandsOutTwoCentimetresDoesNotCount) {
  Normal random(2);
  Histogram histogram;
  for (int i = 0; i < 1000; ++i) {
    histogram.add(random(0.004));
    if (i % 3 == 0) {
      histogram.add(0.022 + random(0.004));
    }
  }
  EXPECT_NEAR(histogram.location(0.004).offset_m, 0, 0.0005);
}

TEST(RobustOffset, NoPointsNoLocation) {
  EXPECT_EQ(Histogram().location(0.005).points, 0U);
}

TEST(RobustOffset, TheVarianceFactorIsThatOfTheBiweight) {
  // E[psi^2] / E[psi']^2 of Tukey's psi with c = 3.5 under the normal distribution, by the midpoint rule.
  const double c = 3.5;
  double squares = 0;
  double slopes = 0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double x = -c + (i + 0.5) * 2 * c / kSteps;
    const double u = x / c;
    const double p = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi) * 2 * c / kSteps;
    squares += p * x * x * std::pow(1 - u * u, 4);
    slopes += p * (1 - u * u) * (1 - 5 * u * u);
  }
  Histogram histogram;
  for (int i = 0; i < 100; ++i) {
    histogram.add(0.0001);
  }
  const RobustOffset found = histogram.location(0.004);
  EXPECT_NEAR(found.variance_m2 / (0.004 * 0.004 / 100), squares / (slopes * slopes), 0.005);
}

TEST(OffsetHistogram, HoldsSixteenMillionPointsInOneBin) {
  const std::uint64_t one = OffsetHistogram::pack(1.0);
  std::uint64_t sum = 0;
  for (int i = 0; i < 16'000'000; ++i) {
    sum += one;
  }
  EXPECT_EQ(OffsetHistogram::count(sum), 16'000'000U);
  EXPECT_NEAR(OffsetHistogram::mean(sum), 1, 1e-12);
}

}  // namespace
}  // namespace roomcut

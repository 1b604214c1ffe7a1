// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/divisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace roomcut::weigh_faces {
namespace {

TEST(Divisions, BinsTileEveryIntervalButItsMargins) {
  const Divisions d({0, 1, 1.1, 4.3}, 0.08, 0.015);
  double total = 0;
  for (int b = 0; b < d.bins(); ++b) {
    total += d.length(b);
    EXPECT_GT(d.length(b), 0.04);
    EXPECT_LT(d.length(b), 0.12);
  }
  EXPECT_NEAR(total, 4.3 - 6 * 0.015, 1e-12);
}

TEST(Divisions, FindsTheBinOfEveryPosition) {
  const Divisions d({0, 1, 1.1, 4.3}, 0.08, 0.015);
  for (int i = 0; i < 4300; ++i) {
    const double x = 0.0005 + 0.001 * i;
    const int b = d.find(x);
    const double to_break = std::min({std::abs(x), std::abs(x - 1), std::abs(x - 1.1), std::abs(x - 4.3)});
    if (to_break < 0.0149) {
      EXPECT_EQ(b, -1) << x;
    } else {
      ASSERT_GE(b, 0) << x;
      EXPECT_LE(d.low(b), x);
      EXPECT_GT(d.high(b), x);
    }
  }
  EXPECT_EQ(d.find(-0.1), -1);
  EXPECT_EQ(d.find(4.4), -1);
}

TEST(Divisions, IntervalsOwnTheirBins) {
  const Divisions d({0, 1, 1.1, 4.3}, 0.08, 0.015);
  const Divisions::Range thin = d.interval_of(1.05);
  EXPECT_EQ(thin.end - thin.begin, 1);
  EXPECT_NEAR(d.low(thin.begin), 1.015, 1e-12);
  EXPECT_NEAR(d.high(thin.begin), 1.085, 1e-12);
  EXPECT_EQ(d.interval_of(0.5).end, thin.begin);
  EXPECT_EQ(d.interval_of(9).begin, d.interval_of(9).end);
}

TEST(Divisions, ThinIntervalsKeepThreeFifths) {
  const Divisions d({0, 0.02}, 0.08, 0.015);
  ASSERT_EQ(d.bins(), 1);
  EXPECT_NEAR(d.length(0), 0.012, 1e-12);
}

}  // namespace
}  // namespace roomcut::weigh_faces

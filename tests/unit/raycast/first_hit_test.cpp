// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/first_hit.h"

#include <gtest/gtest.h>

namespace roomcut::raycast {
namespace {

constexpr LineLengths kLengths{0.4, 0.8, 8};

FirstHit hit(double front, double back, double distance) {
  FirstHit made;
  made.front = front;
  made.back = back;
  made.front_m = front * distance;
  made.back_m = back * distance;
  return made;
}

LineEnds ends_of(const FirstHit& one, const FirstHit& other) {
  LineEnds ends;
  ends.add(one, other, kLengths, 1);
  return ends;
}

TEST(FirstHits, WaysAreWeightedByWhatEndsThere) {
  const std::vector<Crossing> crossings{{1, 1, 0.5F, 0, 0.5F, 0}, {3, 1, 0, 1, 0, 0}, {4, 1, 1, 0, 1, 0}};
  const FirstHit seen = first_hit(crossings);
  EXPECT_DOUBLE_EQ(seen.front, 0.5);
  EXPECT_DOUBLE_EQ(seen.back, 0.5);
  EXPECT_DOUBLE_EQ(seen.front_m, 0.5 * 1);
  EXPECT_DOUBLE_EQ(seen.back_m, 0.5 * 3);
  EXPECT_DOUBLE_EQ(seen.nothing(), 0);
}

TEST(LineEnds, TheSharesOfALineSumToOne) {
  const LineEnds ends = ends_of(hit(0.3, 0.5, 2), hit(0.1, 0.6, 1));
  const double front_back = 0.3 * 0.6 + 0.5 * 0.1;
  EXPECT_NEAR(ends.fronts + ends.backs_thin + ends.backs_wide + front_back + ends.open(), 1, 1e-12);
  EXPECT_NEAR(ends.both_open, 0.2 * 0.3, 1e-12);
}

TEST(LineEnds, BacksCloseTogetherAreAWallAndFarApartARoomNobodyEntered) {
  const FirstHit near = hit(0, 1, 0.1), far = hit(0, 1, 2.5);
  EXPECT_DOUBLE_EQ(ends_of(near, near).backs_thin, 1);
  EXPECT_DOUBLE_EQ(ends_of(near, near).backs_wide, 0);
  EXPECT_DOUBLE_EQ(ends_of(far, near).backs_thin, 0);
  EXPECT_DOUBLE_EQ(ends_of(far, near).backs_wide, 1);
  // Across a courtyard neighbours' backs say nothing of what is between.
  EXPECT_DOUBLE_EQ(ends_of(hit(0, 1, 9), hit(0, 1, 9)).backs_wide, 0);
}

TEST(LineEnds, ItDoesNotMatterWhichEndComesFirst) {
  const FirstHit one = hit(0.3, 0.5, 0.2), other = hit(0.6, 0.1, 0.3);
  const LineEnds there = ends_of(one, other), back = ends_of(other, one);
  EXPECT_DOUBLE_EQ(there.front_back_low, back.front_back_low);
  EXPECT_DOUBLE_EQ(there.open(), back.open());
  EXPECT_GT(there.front_back_low, 0);
}

}  // namespace
}  // namespace roomcut::raycast

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/level_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace roomcut {
namespace {

std::size_t searched(const std::vector<double>& levels, double z) {
  return static_cast<std::size_t>(std::lower_bound(levels.begin(), levels.end(), z) - levels.begin());
}

TEST(LevelFinder, FindsWhatASearchFinds) {
  // Levels 2 mm apart share a step of the table; the tall gap has hundreds.
  const std::vector<double> levels{-1.3, 0.1, 0.102, 2.4, 2.7, 30.0};
  const LevelFinder finder(levels);
  for (int i = -2000; i <= 33000; ++i) {
    const double z = 0.001 * i;
    ASSERT_EQ(finder.first_not_below(z), searched(levels, z)) << z;
  }
  for (const double level : levels) {
    for (const double z : {std::nextafter(level, -100.0), level, std::nextafter(level, 100.0)}) {
      ASSERT_EQ(finder.first_not_below(z), searched(levels, z)) << z;
    }
  }
}

TEST(LevelFinder, HasAnswersBeyondTheLevelsAndForFewOfThem) {
  const std::vector<double> one{1.5};
  const LevelFinder single(one);
  EXPECT_EQ(single.first_not_below(1.5), 0U);
  EXPECT_EQ(single.first_not_below(1.6), 1U);
  EXPECT_EQ(single.first_not_below(1e300), 1U);
  EXPECT_EQ(single.first_not_below(-std::numeric_limits<double>::infinity()), 0U);
  EXPECT_EQ(single.first_not_below(std::numeric_limits<double>::infinity()), 1U);
  EXPECT_EQ(LevelFinder(std::vector<double>{}).first_not_below(0), 0U);
}

}  // namespace
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/convex_hull.h"

#include <gtest/gtest.h>

namespace roomcut {
namespace {

TEST(ConvexHull, BeginsAtTheSmallestCornerAndTurnsLeftWhateverTheOrderOfThePoints) {
  const std::vector<Vec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(convex_hull({{2, 2}, {1, 1}, {0, 2}, {2, 0}, {0, 0}, {1, 0}, {2, 2}}), square);
  EXPECT_EQ(convex_hull(square), square);
  EXPECT_EQ(turned_area(square), 8);
  EXPECT_EQ(turned_area({{0, 0}, {0, 2}, {2, 2}, {2, 0}}), -8);
}

TEST(ConvexHull, OfALineOrASpotHasNoThreeCorners) {
  EXPECT_LT(convex_hull({{0, 0}, {1, 1}, {2, 2}, {3, 3}}).size(), 3U);
  EXPECT_TRUE(convex_hull({{1, 1}, {1, 1}, {1, 1}}).empty());
  EXPECT_TRUE(convex_hull({}).empty());
}

}  // namespace
}  // namespace roomcut

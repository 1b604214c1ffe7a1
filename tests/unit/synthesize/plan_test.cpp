// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace roomcut::synthesize {
namespace {

const Polygon2 kEll = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};

TEST(Plan, InsetOfAnEllKeepsEverySideAtItsDistance) {
  const Polygon2 inner = inset(kEll, std::vector<double>(6, 0.1));
  EXPECT_NEAR(doubled_area(inner) / 2, 12 - 0.1 * 16 + 4 * 0.01, 1e-12);
  EXPECT_NEAR(inner[3].x(), 1.9, 1e-12);
  EXPECT_NEAR(inner[3].y(), 1.9, 1e-12);
}

TEST(Plan, InsetTakesADistancePerSide) {
  const Polygon2 inner = inset({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {0.1, 0.2, 0.3, 0.4});
  EXPECT_NEAR(doubled_area(inner) / 2, (4 - 0.6) * (3 - 0.4), 1e-12);
}

TEST(Plan, InsetRefusesWallsThickerThanTheRoom) {
  EXPECT_THROW(inset({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, std::vector<double>(4, 0.6)), std::invalid_argument);
}

TEST(Plan, InsetRefusesAStepInAStraightWall) {
  EXPECT_THROW(inset({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, {0.1, 0.2, 0.1, 0.1, 0.1}),
               std::invalid_argument);
}

TEST(Plan, ArcCornersLieOnTheCircleInOrder) {
  const auto points = arc_points({1, 0}, {0, 1}, {-1, 0}, 12);
  ASSERT_EQ(points.size(), 12U);
  double before = 0;
  for (const Vec2& p : points) {
    EXPECT_NEAR(p.norm(), 1, 1e-12);
    EXPECT_GT(std::atan2(p.y() + 1e-12, p.x()), before);
    before = std::atan2(p.y() + 1e-12, p.x());
  }
  EXPECT_EQ(points.back(), Vec2(-1, 0));
}

TEST(Plan, ArcOfThreePointsOnALineIsRefused) {
  EXPECT_THROW(arc_points({0, 0}, {1, 0}, {2, 0}, 4), std::invalid_argument);
}

TEST(Plan, InnermostPointOfAnEllLiesInItsCorner) {
  const Vec2 p = innermost_point(kEll);
  EXPECT_TRUE(contains(kEll, p));
  EXPECT_NEAR(border_distance(kEll, p), 4 - 2 * std::sqrt(2.0),
              0.01);  // touches two sides and the inner corner
}

TEST(Plan, SelfIntersectionIsSeenInBowTiesAndTouchingCorners) {
  EXPECT_FALSE(self_intersects(kEll));
  EXPECT_TRUE(self_intersects({{0, 0}, {2, 2}, {2, 0}, {0, 2}}));
  EXPECT_TRUE(self_intersects({{0, 0}, {4, 0}, {4, 3}, {2, 0}, {0, 3}}));
}

}  // namespace
}  // namespace roomcut::synthesize

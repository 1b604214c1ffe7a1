// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/line2.h"

#include <gtest/gtest.h>

namespace roomcut {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Line2, GoesThroughBothPointsInEveryDirection) {
  for (int k = 0; k < 720; ++k) {
    const double phi = k * kPi / 360;
    const Vec2 a(3.0, -7.0);
    const Vec2 b = a + 5.0 * Vec2(std::cos(phi), std::sin(phi));
    const Line2 line = line_through(a, b);
    EXPECT_GE(line.theta, 0.0);
    EXPECT_LT(line.theta, kPi);
    EXPECT_NEAR(line.distance(a), 0.0, 1e-12);
    EXPECT_NEAR(line.distance(b), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(line.along(b) - line.along(a)), 5.0, 1e-12);
    EXPECT_NEAR((line.at(line.along(b)) - b).norm(), 0.0, 1e-12);
  }
}

TEST(Line2, TheOrderOfThePointsDoesNotMatter) {
  const Vec2 a(1.5, 2.25), b(-4.0, 9.0);
  EXPECT_NEAR(line_through(a, b).theta, line_through(b, a).theta, 1e-14);
  EXPECT_NEAR(line_through(a, b).d, line_through(b, a).d, 1e-13);
}

TEST(Line2, NormalisingTurnsTheSignOfDWithEveryHalfTurn) {
  const Vec2 p(2.0, -1.0);
  for (int turns = -3; turns <= 3; ++turns) {
    const double theta = 0.4 + turns * kPi;
    const double d = std::cos(theta) * p.x() + std::sin(theta) * p.y();
    const Line2 line = normalised(theta, d);
    EXPECT_NEAR(line.theta, 0.4, 1e-12);
    EXPECT_NEAR(line.distance(p), 0.0, 1e-12);
  }
}

TEST(Line2, AnglesBetweenUndirectedLinesAreAtMostARightAngle) {
  EXPECT_NEAR(angle_between(0.01, kPi - 0.01), 0.02, 1e-12);
  EXPECT_NEAR(angle_between(0.0, kPi / 2), kPi / 2, 1e-12);
  EXPECT_NEAR(angle_between(2.0, 2.0), 0.0, 1e-12);
}

}  // namespace
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/angle_classes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/refine_lines/made_points.h"

namespace roomcut::refine_lines {
namespace {

using testing::kDeg;

Direction direction(const std::string& id, double degrees, double sigma_degrees) {
  return {id, degrees * kDeg, sigma_degrees * kDeg, true};
}

TEST(AngleClasses, ParallelAndPerpendicularWallsAreOneClass) {
  const AngleClasses found = find_angle_classes({direction("a", 20.01, 0.01), direction("b", 110, 0.01),
                                                 direction("c", 20.3, 0.2), direction("d", 65, 0.01)});
  EXPECT_EQ(found.angle.size(), 1U);
  EXPECT_EQ(found.class_of, (std::vector<int>{0, 0, 0, -1}));
  EXPECT_NEAR(found.angle[0], 20.005 * kDeg, 0.003 * kDeg);
}

TEST(AngleClasses, AWallThatIsMeasurablyOffStaysOut) {
  const AngleClasses found =
      find_angle_classes({direction("a", 0, 0.01), direction("b", 0.3, 0.01), direction("c", 90, 0.02)});
  EXPECT_EQ(found.class_of[1], -1);
  EXPECT_EQ(found.class_of[0], found.class_of[2]);
}

TEST(AngleClasses, AVagueWallBeyondOneAndAHalfDegreesStaysOutToo) {
  const AngleClasses found =
      find_angle_classes({direction("a", 0, 0.01), direction("b", 0, 0.01), direction("c", 1.6, 0.9)});
  EXPECT_EQ(found.class_of[2], -1);
}

TEST(AngleClasses, TheWrapAtZeroAndNinetyDegreesIsSeamless) {
  const AngleClasses found = find_angle_classes(
      {direction("a", 179.99, 0.02), direction("b", 0.01, 0.02), direction("c", 89.99, 0.02)});
  EXPECT_EQ(found.class_of, (std::vector<int>{0, 0, 0}));
  EXPECT_NEAR(off_class(found.angle[0], 0), 0, 0.01 * kDeg);
}

TEST(AngleClasses, TheOrderOfTheLinesDoesNotMatter) {
  std::vector<Direction> directions{direction("a", 0.02, 0.05), direction("b", 90.05, 0.05),
                                    direction("c", 0.1, 0.05), direction("d", 45, 0.05),
                                    direction("e", 135.1, 0.05)};
  const AngleClasses forwards = find_angle_classes(directions);
  std::reverse(directions.begin(), directions.end());
  AngleClasses backwards = find_angle_classes(directions);
  std::reverse(backwards.class_of.begin(), backwards.class_of.end());
  EXPECT_EQ(forwards.class_of, backwards.class_of);
  EXPECT_EQ(forwards.angle, backwards.angle);
}

TEST(AngleClasses, LinesThatTakeNoPartAreLeftAlone) {
  std::vector<Direction> directions{direction("a", 0, 0.01), direction("b", 0, 0.01)};
  directions[1].takes_part = false;
  EXPECT_TRUE(find_angle_classes(directions).angle.empty());
}

}  // namespace
}  // namespace roomcut::refine_lines

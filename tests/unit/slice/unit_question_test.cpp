// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/unit_question.h"

#include <gtest/gtest.h>

namespace roomcut::slice {
namespace {

Slices slices_with(const std::vector<double>& heights, double widest, const std::string& unit = "m") {
  Slices slices;
  slices.frame.unit = unit;
  slices.bbox_max = Vec3(widest, 0.5 * widest, heights.back());
  for (const double z : heights) {
    slices.levels.emplace_back();
    slices.levels.back().z = z;
  }
  return slices;
}

TEST(UnitQuestion, is_asked_where_storeys_are_as_high_as_usual_ones_in_feet) {
  const std::string two = unit_question(slices_with({0, 8.2, 9.2, 17.4}, 80));
  EXPECT_NE(two.find("2 storeys are 8.2 m to 8.2 m high, in feet 2.5 m"), std::string::npos) << two;
  EXPECT_NE(two.find("--unit ft"), std::string::npos) << two;
  EXPECT_NE(unit_question(slices_with({0, 8.2}, 33)), "");
}

TEST(UnitQuestion, is_not_asked_of_houses_in_metres_halls_and_scans_with_another_unit) {
  EXPECT_EQ(unit_question(slices_with({0, 2.5, 2.8, 5.3}, 12)), "");
  EXPECT_EQ(unit_question(slices_with({0, 8}, 60)), "") << "a hall";
  EXPECT_EQ(unit_question(slices_with({0, 8, 8.3, 11}, 60)), "") << "a hall with offices";
  EXPECT_EQ(unit_question(slices_with({0, 2.5, 2.8, 5.3}, 12, "ft")), "");
  EXPECT_EQ(unit_question(slices_with({0, 8.2}, 33, "ft")), "");
}

}  // namespace
}  // namespace roomcut::slice

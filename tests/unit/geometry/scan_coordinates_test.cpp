// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/scan_coordinates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace roomcut {
namespace {

Frame utm(double lean_deg) {
  const double lean = lean_deg * std::numbers::pi / 180;
  Frame frame;
  frame.origin[0] = 691234.123456;
  frame.origin[1] = 5334567.25;
  frame.origin[2] = 512.5;
  frame.level[0] = 0.6 * std::sin(lean);
  frame.level[1] = -0.8 * std::sin(lean);
  frame.level[2] = std::cos(lean);
  return frame;
}

TEST(ScanCoordinates, there_and_back_is_the_same_point) {
  for (const double lean : {0.0, 0.8, 4.9}) {
    const ScanCoordinates scan(utm(lean));
    const Vec3 local(12.5, -31.25, 7);
    EXPECT_LT((scan.to_local(scan.to_scan(local)) - local).norm(), 1e-8);
    EXPECT_LT((scan.plan_to_local(scan.plan_to_scan(local.head<2>())) - local.head<2>()).norm(), 1e-8);
    EXPECT_NEAR(scan.height_to_local(local.head<2>(), scan.height_to_scan(local.head<2>(), 7)), 7, 1e-8);
  }
}

TEST(ScanCoordinates, of_a_scan_that_stood_level_the_origin_is_added_and_nothing_else) {
  const ScanCoordinates scan(utm(0));
  EXPECT_EQ(scan.to_scan(Vec3(1, 2, 3)), Vec3(691235.123456, 5334569.25, 515.5));
  EXPECT_EQ(scan.plan_to_scan({1, 2}), Vec2(691235.123456, 5334569.25));
}

TEST(ScanCoordinates, the_plan_is_that_of_the_points_at_the_height_of_the_origin) {
  const ScanCoordinates scan(utm(3));
  const Vec2 place(20, -10);
  EXPECT_LT((scan.plan_to_scan(place) - scan.to_scan(Vec3(20, -10, 0)).head<2>()).norm(), 1e-9);
  EXPECT_GT((scan.plan_to_scan(place) - scan.to_scan(Vec3(20, -10, 3)).head<2>()).norm(), 0.1);
}

TEST(ScanCoordinates, up_of_the_scan_is_where_the_frame_says) {
  const Frame frame = utm(3);
  const ScanCoordinates scan(frame);
  const Vec3 up = scan.to_scan(Vec3(0, 0, 1)) - scan.to_scan(Vec3(0, 0, 0));
  EXPECT_LT((up - Vec3(frame.level[0], frame.level[1], frame.level[2])).norm(), 1e-8);
}

}  // namespace
}  // namespace roomcut

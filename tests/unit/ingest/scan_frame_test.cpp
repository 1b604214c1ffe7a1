// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_frame.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "memory_scan.h"
#include "stages/ingest/scan_middle.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

ScanBlock block_of(const std::vector<Vec3>& points) {
  ScanBlock block;
  block.resize(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    block.x[i] = points[i].x();
    block.y[i] = points[i].y();
    block.z[i] = points[i].z();
  }
  return block;
}

ScanFrame frame_of(const std::vector<Vec3>& points, const std::string& unit = "m",
                   const std::string& up = "z") {
  return choose_frame(scan_middle(MemoryScan(points), block_of(points), 3000 / metres_of(unit)), unit, up);
}

Vec3 up_vector(const std::string& up) {
  Vec3 vector(0, 0, 0);
  vector["xyz"[0] == up.back() ? 0 : (up.back() == 'y' ? 1 : 2)] = up.front() == '-' ? -1 : 1;
  return vector;
}

TEST(ScanFrame, turns_every_up_axis_upwards_without_mirroring) {
  for (const std::string up : {"x", "y", "z", "-x", "-y", "-z"}) {
    const ScanFrame frame = frame_of({Vec3(1, 2, 3)}, "m", up);
    EXPECT_EQ(frame.turned(up_vector(up)), Vec3(0, 0, 1)) << up;
    Eigen::Matrix3d turn;
    for (int k = 0; k < 3; ++k) {
      turn.col(k) = frame.turned(Vec3::Unit(k));
    }
    EXPECT_EQ(turn.determinant(), 1) << up;
  }
  EXPECT_EQ(frame_of({Vec3(0, 0, 0)}, "m", "y").turned(Vec3(1, 2, 3)), Vec3(1, -3, 2));
}

TEST(ScanFrame, converts_units_to_metres) {
  EXPECT_NEAR(frame_of({Vec3(1, 1, 1)}, "mm").turned(Vec3(1500, 0, 0)).x(), 1.5, 1e-12);
  EXPECT_NEAR(frame_of({Vec3(1, 1, 1)}, "cm").turned(Vec3(150, 0, 0)).x(), 1.5, 1e-12);
  EXPECT_NEAR(frame_of({Vec3(1, 1, 1)}, "ft").turned(Vec3(10, 0, 0)).x(), 3.048, 1e-12);
}

TEST(ScanFrame, refuses_words_it_does_not_know) {
  EXPECT_THROW(frame_of({Vec3(1, 1, 1)}, "yd"), std::invalid_argument);
  EXPECT_THROW(frame_of({Vec3(1, 1, 1)}, "m", "w"), std::invalid_argument);
}

TEST(ScanFrame, has_its_origin_at_the_mean_of_the_points_whatever_their_frame_unit_rounding_and_order) {
  std::vector<Vec3> points = Room().points();
  const ScanFrame here = frame_of(points);
  const Vec3 shift(691'234.5678, 5'334'567.8912, -512.3456);
  std::vector<Vec3> elsewhere = points;
  for (Vec3& point : elsewhere) {
    point = 1000 * (point + shift);
    point = point.array().round();  // whole millimetres
  }
  std::reverse(elsewhere.begin(), elsewhere.end());
  const ScanFrame there = frame_of(elsewhere, "mm");
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(there.frame.origin[k] - shift[k], here.frame.origin[k], 1e-5) << k;
    EXPECT_NEAR(here.local(points[99])[k], there.local(1000 * (points[99] + shift))[k], 1e-5) << k;
  }
}

TEST(ScanFrame, moves_large_coordinates_so_that_float32_keeps_a_tenth_of_a_millimetre) {
  const Vec3 corner(4512345.678901, 5498765.432109, 312.25);
  const std::vector<Vec3> points{corner, corner + Vec3(10.00005, 0, 0), corner + Vec3(0, 7.12345, 2.5)};
  const ScanFrame frame = frame_of(points);
  LocalPoints local;
  to_local(block_of(points), frame, UnitScale(0.05), local);
  ASSERT_EQ(local.x.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(local.x[i] + frame.frame.origin[0], points[i].x(), 5e-5);
    EXPECT_NEAR(local.y[i] + frame.frame.origin[1], points[i].y(), 5e-5);
    EXPECT_NEAR(local.z[i] + frame.frame.origin[2], points[i].z(), 5e-5);
  }
}

TEST(ScanFrame, is_not_misled_by_ghosts_and_missing_values) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vec3> points{Vec3(1e30, 0, 0), Vec3(kNan, 1, 1), Vec3(-5e5, 9e6, 1e5)};
  for (int i = 0; i < 20; ++i) {
    points.emplace_back(i, 2 * i, 1);
  }
  const ScanFrame frame = frame_of(points);
  EXPECT_EQ(frame.frame.origin[0], 9.5);
  LocalPoints local;
  to_local(block_of(points), frame, UnitScale(0.05), local);
  EXPECT_EQ(local.x.size(), 20U);
  EXPECT_EQ(local.not_finite, 1U);
  EXPECT_EQ(local.far, 2U);
  EXPECT_EQ(local.y[19], 19) << "the order is kept";
}

TEST(ScanFrame, turns_normals_with_the_points) {
  ScanBlock block = block_of({Vec3(1, 2, 3)});
  block.nx = {0};
  block.ny = {1};
  block.nz = {0};
  LocalPoints local;
  to_local(block, choose_frame(Vec3(0, 0, 0), "mm", "-y"), UnitScale(0.05), local);
  EXPECT_EQ(Eigen::Vector3f(local.nx[0], local.ny[0], local.nz[0]), Eigen::Vector3f(0, 0, -1));
}

TEST(UnitScale, rounds_down_on_both_sides_of_zero) {
  const UnitScale scale(1.024);  // a unit is a millimetre
  EXPECT_EQ(scale.units(0.0015F), 1);
  EXPECT_EQ(scale.units(0.0F), 0);
  EXPECT_EQ(scale.units(-0.0005F), -1);
  EXPECT_EQ(scale.units(-0.0015F), -2);
}

}  // namespace
}  // namespace roomcut::testing

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_frame.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace roomcut {
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
  return choose_frame(block_of(points), unit, up, 0.05);
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

TEST(ScanFrame, keeps_the_origin_of_small_coordinates) {
  const ScanFrame frame = frame_of({Vec3(-900, 999, 12), Vec3(-890, 989, 14), Vec3(-880, 980, 13)});
  EXPECT_EQ(frame.frame.origin[0], 0);
  EXPECT_EQ(frame.frame.origin[1], 0);
  EXPECT_EQ(frame.frame.origin[2], 0);
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
  EXPECT_EQ(std::fmod(frame.frame.origin[0], 100), 0);
}

TEST(ScanFrame, is_not_misled_by_ghosts_and_missing_values) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vec3> points{Vec3(1e30, 0, 0), Vec3(kNan, 1, 1), Vec3(-5e5, 9e6, 1e5)};
  for (int i = 0; i < 20; ++i) {
    points.emplace_back(i, 2 * i, 1);
  }
  const ScanFrame frame = frame_of(points);
  EXPECT_EQ(frame.frame.origin[0], 0);
  LocalPoints local;
  to_local(block_of(points), frame, UnitScale(0.05), local);
  EXPECT_EQ(local.x.size(), 20U);
  EXPECT_EQ(local.not_finite, 1U);
  EXPECT_EQ(local.far, 2U);
  EXPECT_EQ(local.y[19], 38) << "the order is kept";
}

TEST(ScanFrame, turns_normals_with_the_points) {
  ScanBlock block = block_of({Vec3(1, 2, 3)});
  block.nx = {0};
  block.ny = {1};
  block.nz = {0};
  LocalPoints local;
  to_local(block, choose_frame(block, "mm", "-y", 0.05), UnitScale(0.05), local);
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
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/coverage.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>

namespace roomcut::ingest {
namespace {

VoxelMask bit(int dx, int dy, int dz) {
  return VoxelMask{1} << (3 * (3 * (dy + 1) + dx + 1) + dz + 1);
}

TEST(Projected, sees_each_voxel_in_the_right_place_along_each_axis) {
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        EXPECT_EQ(projected(bit(dx, dy, dz), 0), 1U << (3 * (dy + 1) + dz + 1));
        EXPECT_EQ(projected(bit(dx, dy, dz), 1), 1U << (3 * (dx + 1) + dz + 1));
        EXPECT_EQ(projected(bit(dx, dy, dz), 2), 1U << (3 * (dy + 1) + dx + 1));
      }
    }
  }
  EXPECT_EQ(projected((1U << 27) - 1, 0), 511U);
  EXPECT_EQ(projected((1U << 27) - 1, 1), 511U);
  EXPECT_EQ(projected((1U << 27) - 1, 2), 511U);
}

TEST(CoveredCells, takes_holes_that_chance_explains_for_covered) {
  EXPECT_TRUE(covered_cells(11, 6).whole);
  EXPECT_EQ(covered_cells(11, 6).cells, 9);
  EXPECT_TRUE(covered_cells(500, 9).whole);
}

TEST(CoveredCells, sees_a_border_where_points_are_dense) {
  EXPECT_FALSE(covered_cells(60, 6).whole);
  EXPECT_NEAR(covered_cells(60, 6).cells, 6, 0.01);
  EXPECT_NEAR(covered_cells(5000, 3).cells, 3, 1e-12);
}

TEST(CoveredCells, is_right_on_average_for_random_points) {
  std::mt19937_64 random(7);
  for (const double mean : {1.0, 2.0, 5.0, 20.0}) {
    for (const int truly : {6, 9}) {
      std::poisson_distribution<std::uint32_t> poisson(mean);
      double points = 0;
      double estimate = 0;
      for (int i = 0; i < 20'000; ++i) {
        std::uint32_t sum = 0;
        int filled = 0;
        for (int k = 0; k < truly; ++k) {
          const std::uint32_t n = poisson(random);
          sum += n;
          filled += n > 0 ? 1 : 0;
        }
        if (sum >= 6) {
          points += truly;
          estimate += covered_cells(sum, filled).cells;
        }
      }
      const double slack =
          truly == 9 ? 0.04 : (mean > 4 ? 0.07 : 0.5);  // a border shows only where points are dense
      EXPECT_NEAR(estimate / points, 1, slack) << mean << " points in each of " << truly;
    }
  }
}

TEST(ChordOfSquare, agrees_with_sampling) {
  for (int angle = 0; angle < 180; angle += 7) {
    const double nx = std::cos(angle * std::numbers::pi / 180);
    const double ny = std::sin(angle * std::numbers::pi / 180);
    for (const double d : {0.0, 0.2, 0.5, -0.5}) {
      int inside = 0;
      constexpr int kSteps = 60'000;
      for (int i = 0; i < kSteps; ++i) {
        const double t = 6.0 * (i + 0.5) / kSteps - 3;
        inside += std::abs(d * nx - t * ny) < 1.5 && std::abs(d * ny + t * nx) < 1.5 ? 1 : 0;
      }
      EXPECT_NEAR(chord_of_square(nx, ny, d), 6.0 * inside / kSteps, 1e-3) << angle << " " << d;
    }
  }
}

}  // namespace
}  // namespace roomcut::ingest

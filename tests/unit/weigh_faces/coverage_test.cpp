// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace roomcut::weigh_faces {
namespace {

TEST(AreaTable, SumsAnyRectangle) {
  const int nx = 7;
  const int ny = 5;
  std::vector<float> values;
  for (int i = 0; i < nx * ny; ++i) {
    values.push_back(static_cast<float>((i * 13) % 11));
  }
  const AreaTable table(values, nx, ny);
  for (int x0 = 0; x0 < nx; ++x0) {
    for (int y0 = 0; y0 < ny; ++y0) {
      double sum = 0;
      for (int y = y0; y < ny; ++y) {
        for (int x = x0; x < nx - 1; ++x) {
          sum += values[static_cast<std::size_t>(y * nx + x)];
        }
      }
      EXPECT_NEAR(table.bins(x0, nx - 1, y0, ny), x0 < nx - 1 ? sum : 0, 1e-9);
    }
  }
}

TEST(OccupancyWeight, IsTheInverseOfTheChanceToSeeABin) {
  EXPECT_NEAR(occupancy_weight(1.0, 1.0), 1 / (1 - std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(occupancy_weight(1e6, 1.0), 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(occupancy_weight(0.0, 1.0), 25.0)
      << "an occupied bin of an all but empty surface stays bounded";
}

TEST(WindowDensity, GrowsTheWindowUntilItHoldsTenPoints) {
  const int n = 11;
  std::vector<float> points(n * n, 0.0F);
  points[5 * n + 5] = 4;
  points[5 * n + 8] = 6;  // reached by the window of radius 3 only
  const std::vector<float> areas(n * n, 0.5F);
  EXPECT_NEAR(window_density(AreaTable(points, n, n), AreaTable(areas, n, n), 5, 5), 10 / (49 * 0.5), 1e-9);
}

}  // namespace
}  // namespace roomcut::weigh_faces

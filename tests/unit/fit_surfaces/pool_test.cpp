// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/pool.h"

#include <gtest/gtest.h>

#include "tests/unit/robust/normal.h"

namespace roomcut::fit_surfaces {
namespace {

TEST(PoolHeights, HeightsThatTrulyDifferStayWhereTheyAre) {
  std::vector<PooledHeight> heights = {{2.73, 0.0001}, {2.75, 0.0001}, {2.77, 0.0001}};
  pool_heights(heights);
  EXPECT_NEAR(heights[0].z, 2.73, 1e-5);
  EXPECT_NEAR(heights[1].z, 2.75, 1e-5);
  EXPECT_NEAR(heights[2].z, 2.77, 1e-5);
  EXPECT_NEAR(heights[0].sigma, 0.0001, 1e-6);
}

TEST(PoolHeights, HeightsThatDifferByChanceBecomeOne) {
  roomcut::testing::Normal random(1);
  std::vector<PooledHeight> heights;
  for (int i = 0; i < 20; ++i) {
    heights.push_back({2.7 + random(0.01), 0.01});
  }
  pool_heights(heights);
  for (const PooledHeight& h : heights) {
    EXPECT_EQ(h.z, heights[0].z);
    EXPECT_NEAR(h.z, 2.7, 0.006);
    EXPECT_GE(h.sigma, 0.005);
  }
}

TEST(PoolHeights, ALoweredCeilingAmongEqualOnesKeepsItsHeight) {
  std::vector<PooledHeight> heights = {
      {2.75, 0.001}, {2.7505, 0.001}, {2.7497, 0.001}, {2.75, 0.001}, {2.72, 0.001}};
  pool_heights(heights);
  EXPECT_EQ(heights[4].z, 2.72);
  EXPECT_EQ(heights[0].z, heights[1].z);
}

TEST(PoolHeights, OneHeightAloneStaysAsItIs) {
  std::vector<PooledHeight> heights = {{2.72, 0.001}};
  pool_heights(heights);
  EXPECT_EQ(heights[0].z, 2.72);
  EXPECT_EQ(heights[0].sigma, 0.001);
}

}  // namespace
}  // namespace roomcut::fit_surfaces

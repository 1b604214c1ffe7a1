// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/open_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "stages/slice/slice.h"
#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::slice {
using namespace roomcut::testing;

namespace {

using testing::SyntheticCloud;

/// A room of 8 x 6 m with walls on three sides; on the fourth, at y = 0, glass. A terrace lies before it.
void add_glazed_room(SyntheticCloud& cloud) {
  cloud.horizontal({0, 0}, {8, 6}, 0.0);
  cloud.horizontal({0, 0}, {8, 6}, 3.0);
  cloud.wall({0, 0}, {0, 6}, 0, 3);
  cloud.wall({0, 6}, {8, 6}, 0, 3);
  cloud.wall({8, 6}, {8, 0}, 0, 3);
  cloud.horizontal({-2, -6}, {10, -0.2}, 0.0);
}

std::vector<OpenEdge> edges_of(const SyntheticCloud& cloud) {
  return slice_cloud(cloud.header(), cloud.source(), {}).open_edges;
}

TEST(OpenEdges, AreWhereACeilingEndsAtGlass) {
  for (const double density : {100.0, 500.0}) {
    for (const double degrees : {0.0, 17.0, 45.0}) {
      SyntheticCloud cloud(0.004, density);
      const double angle = degrees * std::numbers::pi / 180;
      cloud.place(angle, {0.31, -0.17});
      add_glazed_room(cloud);
      const std::vector<OpenEdge> edges = edges_of(cloud);
      SCOPED_TRACE(::testing::Message() << density << " points per m^2, turned by " << degrees);
      ASSERT_EQ(edges.size(), 1U);
      EXPECT_GT(edges[0].length_m(), 5.5);
      const Line2 glass{std::fmod(angle + std::numbers::pi / 2, std::numbers::pi), 0};
      for (const Vec2& end : {edges[0].a, edges[0].b}) {
        EXPECT_NEAR(glass.normal().dot(end - Vec2(0.31, -0.17)), 0, 0.15);
      }
    }
  }
}

TEST(OpenEdges, AreWallsOfTheSliceBelowTheCeiling) {
  SyntheticCloud cloud;
  add_glazed_room(cloud);
  const Slices slices = slice_cloud(cloud.header(), cloud.source(), {}).slices;
  SliceParams without;
  without.open_edges = false;
  const Slices plain = slice_cloud(cloud.header(), cloud.source(), without).slices;
  const OccupancyGrid& grid = slices.wall_slices.back();
  const auto length = static_cast<std::size_t>(5.5 / slices.tau_m);
  EXPECT_GT(grid.size(), plain.wall_slices.back().size() + length);
  for (std::size_t i = 1; i < grid.size(); ++i) {
    EXPECT_TRUE(std::tie(grid.iy[i - 1], grid.ix[i - 1]) < std::tie(grid.iy[i], grid.ix[i])) << "sorted";
  }
}

TEST(OpenEdges, AreNotWhereAWallStands) {
  SyntheticCloud cloud;
  add_glazed_room(cloud);
  cloud.wall({0, 0}, {8, 0}, 0, 3);
  EXPECT_TRUE(edges_of(cloud).empty());
}

TEST(OpenEdges, AreNotWhereTheNextCeilingIsHigher) {
  SyntheticCloud cloud;
  add_glazed_room(cloud);
  cloud.horizontal({-2, -6}, {10, -0.2}, 4.5);
  for (const OpenEdge& edge : edges_of(cloud))
    EXPECT_EQ(edge.level, 2U) << "only the higher one ends in the open";
}

TEST(OpenEdges, AreNotWhereNothingWasSeenBeyond) {
  SyntheticCloud cloud;
  cloud.horizontal({0, 0}, {8, 6}, 0.0);
  cloud.horizontal({0, 0}, {8, 6}, 3.0);
  cloud.wall({0, 0}, {0, 6}, 0, 3);
  EXPECT_TRUE(edges_of(cloud).empty());
}

}  // namespace
}  // namespace roomcut::slice

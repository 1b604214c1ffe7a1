// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/plan/subdivision.h"

#include <gtest/gtest.h>

namespace roomcut {
namespace {

std::vector<std::int32_t> loop(const Subdivision& plan, std::int32_t start) {
  std::vector<std::int32_t> corners;
  std::int32_t h = start;
  do {
    corners.push_back(plan.half_edges[h].origin);
    EXPECT_EQ(plan.half_edges[plan.half_edges[h].next].prev, h);
    EXPECT_EQ(plan.half_edges[h].face, plan.half_edges[start].face);
    EXPECT_EQ(plan.target(h), plan.half_edges[plan.half_edges[h].next].origin);
    h = plan.half_edges[h].next;
  } while (h != start);
  return corners;
}

TEST(Subdivision, StartsAsOneRectangleWithTheOutsideAroundIt) {
  const Subdivision plan({0, 0}, {4, 3});
  EXPECT_EQ(loop(plan, plan.face_start[0]), (std::vector<std::int32_t>{0, 1, 2, 3}));
  EXPECT_EQ(loop(plan, 1), (std::vector<std::int32_t>{1, 0, 3, 2}));
  EXPECT_EQ(plan.half_edges[1].face, Subdivision::kOutside);
  EXPECT_EQ(plan.locate({1, 1}), 0);
}

TEST(Subdivision, AVertexInAnEdgeIsSeenByBothItsFaces) {
  Subdivision plan({0, 0}, {4, 3});
  const std::int32_t h = plan.split_edge(0, {1, 0});
  EXPECT_EQ(plan.half_edges[h].origin, 4);
  EXPECT_EQ(loop(plan, 0), (std::vector<std::int32_t>{0, 4, 1, 2, 3}));
  EXPECT_EQ(loop(plan, 1), (std::vector<std::int32_t>{4, 0, 3, 2, 1}));
}

TEST(Subdivision, ASplitFaceFallsIntoItsTwoSidesAndIsFoundAgain) {
  Subdivision plan({0, 0}, {4, 3});
  const std::int32_t bottom = plan.split_edge(0, {1, 0});  // side 0 -> 1
  const std::int32_t top = plan.split_edge(4, {1, 3});     // side 2 -> 3
  // The line x = 1, normal (1, 0): the corners after `top` have x < 1.
  plan.split_face(top, bottom, 7, Line2{0, 1});
  const std::int32_t left = plan.locate({0.5, 1});
  const std::int32_t right = plan.locate({2, 1});
  ASSERT_NE(left, right);
  EXPECT_EQ(loop(plan, plan.face_start[left]).size(), 4U);
  for (const std::int32_t face : {left, right}) {
    double mean = 0;
    for (const std::int32_t v : loop(plan, plan.face_start[face])) {
      mean += 0.25 * plan.vertices[v].x();
    }
    EXPECT_EQ(mean < 1, face == left);
  }
  EXPECT_EQ(plan.faces_in_tree_order().size(), 2U);
}

TEST(Subdivision, ARemovedEdgeLeavesOneFaceWithoutItsVertices) {
  Subdivision plan({0, 0}, {4, 3});
  const std::int32_t bottom = plan.split_edge(0, {1, 0});
  const std::int32_t top = plan.split_edge(4, {1, 3});
  plan.split_face(top, bottom, 7, Line2{0, 1});
  const auto chord = static_cast<std::int32_t>(plan.half_edges.size() - 2);
  EXPECT_EQ(plan.half_edges[chord].line, 7);
  const std::int32_t kept = plan.half_edges[chord].face;
  plan.remove_edge(chord);
  EXPECT_TRUE(plan.is_removed(chord));
  EXPECT_EQ(loop(plan, plan.face_start[kept]).size(), 4U);  // the corners of the rectangle only
  EXPECT_EQ(plan.faces_in_tree_order(), (std::vector<std::int32_t>{kept}));
}

}  // namespace
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/seen_through.h"

#include <gtest/gtest.h>

#include "common/cells/plan_walk.h"
#include "tests/unit/cells/three_faces.h"
#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::weigh_faces {
using namespace roomcut::raycast;

namespace {

/// A facade of 37 cm: inner face at x = 4, outer plane of its windows at x = 4.37; the room lies west of it.
struct Facade {
  CellComplex complex = grid_complex({-1, 0, 4, 4.37, 6}, {-1, 0, 4, 5}, {0, 2.6});
  std::size_t inner = complex.wall_face(edge_near(complex, {4, 2}), 0);
  std::size_t outer = complex.wall_face(edge_near(complex, {4.37, 2}), 0);
  FaceWeights weights = no_weights(complex);

  void see(std::size_t face, float omega, bool from_west, std::uint32_t points) {
    weights.wall_omega[face] = omega;
    (from_west ? weights.wall_left : weights.wall_right)[face] = omega;
    weights.wall_points[face] = points;
  }
};

TEST(DiscountSeenThrough, AFewPointsBehindADenseWallAreNoThinSampleOfAWall) {
  Facade facade;
  facade.see(facade.inner, 0.5F, true, 4000);
  facade.see(facade.outer, 0.4F, true, 100);
  discount_seen_through(facade.complex, facade.weights);
  EXPECT_LT(facade.weights.wall_omega[facade.outer], 0.1F);
  EXPECT_FLOAT_EQ(facade.weights.wall_left[facade.outer], facade.weights.wall_omega[facade.outer]);
  EXPECT_EQ(facade.weights.wall_omega[facade.inner], 0.5F);
}

TEST(DiscountSeenThrough, TheOtherFaceOfAWallMayBeSparse) {
  Facade facade;
  facade.see(facade.inner, 0.9F, true, 4000);
  facade.see(facade.outer, 0.8F, false, 100);  // the next room, seen through its door
  discount_seen_through(facade.complex, facade.weights);
  EXPECT_EQ(facade.weights.wall_omega[facade.outer], 0.8F);
}

TEST(DiscountSeenThrough, AWallAsDenseAsTheOneInFrontStays) {
  Facade facade;
  facade.see(facade.inner, 0.5F, true, 2000);
  facade.see(facade.outer, 0.5F, true, 1000);
  discount_seen_through(facade.complex, facade.weights);
  EXPECT_EQ(facade.weights.wall_omega[facade.outer], 0.5F);
}

TEST(WalkBeside, LeavesAStraightSideByThePartThatItMeets) {
  // The left side of the box, looking right: the way at y = 1.2 meets the upper part of the side x = 1.
  CellComplex complex = three_faces();
  complex.vertices[0].y() = 0.4;
  complex.vertices[1].y() = 0.4;
  const std::size_t left_side = 4;  // from (0, 2) to (0, 0.4)
  EXPECT_EQ(walk_beside(complex, left_side, true, 2), 2);
  complex.vertices[6].y() = 1.2;  // and now at y = 0.8 the lower one
  EXPECT_EQ(walk_beside(complex, left_side, true, 2), 1);
}

TEST(WalkBeside, PassesSliversUpToTheDistance) {
  const CellComplex complex = grid_complex({0, 4, 4.01, 8}, {0, 4}, {0, 2.6});
  const std::size_t edge = edge_near(complex, {4, 2});
  const std::int32_t sliver = walk_beside(complex, edge, false, 0.005);
  const std::int32_t beyond = walk_beside(complex, edge, false, 0.03);
  EXPECT_NEAR(complex.centroid(static_cast<std::size_t>(sliver)).x(), 4.005, 1e-9);
  EXPECT_NEAR(complex.centroid(static_cast<std::size_t>(beyond)).x(), 6.005, 1e-9);
  EXPECT_EQ(walk_beside(complex, edge, false, 10), -1) << "out of the box";
}

}  // namespace
}  // namespace roomcut::weigh_faces

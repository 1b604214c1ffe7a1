// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/face_walk.h"

#include <gtest/gtest.h>

#include "tests/unit/cells/three_faces.h"
#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::raycast {
using namespace roomcut::weigh_faces;

namespace {

struct Cube {
  CellComplex complex = grid_complex({-2, 0, 3, 5}, {-2, 0, 3, 5}, {-1, 0, 3, 4});
  std::vector<bool> empty = [this] {
    std::vector<bool> e(complex.cells(), false);
    e[complex.cell(4, 1)] = true;
    return e;
  }();
  FaceWeights weights = weights_of(complex, empty);
};

TEST(FaceWalk, CrossesFacesInOrderAndStopsAtTheBox) {
  const Cube cube;
  const FaceWalk walk(cube.complex, cube.weights);
  std::vector<Crossing> crossings;
  walk.follow({{1, 1, 1}, {1, 0, 0}, 4, 1}, crossings);
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_NEAR(crossings[0].distance, 2, 1e-12);
  EXPECT_EQ(crossings[0].front, 1) << "from inside the room the wall shows its front";
  EXPECT_EQ(crossings[0].back, 0);
  EXPECT_NEAR(crossings[1].distance, 4, 1e-12);
  EXPECT_EQ(crossings[1].omega, 0);
}

TEST(FaceWalk, SeesTheBackOfAWallFromOutside) {
  const Cube cube;
  const FaceWalk walk(cube.complex, cube.weights);
  std::vector<Crossing> crossings;
  walk.follow({{-1, 1, 1}, {1, 0, 0}, 3, 1}, crossings);
  ASSERT_EQ(crossings.size(), 3U);
  EXPECT_EQ(crossings[0].back, 1);
  EXPECT_EQ(crossings[1].front, 1);
}

TEST(FaceWalk, GoesUpAndDownThroughLevels) {
  const Cube cube;
  const FaceWalk walk(cube.complex, cube.weights);
  std::vector<Crossing> crossings;
  walk.follow({{1, 1, 1}, {0, 0, -1}, 4, 1}, crossings);
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_EQ(crossings[0].front, 1) << "floor from above";
  walk.follow({{1, 1, -0.5}, {0, 0, 1}, 4, 0}, crossings);
  ASSERT_EQ(crossings.size(), 3U);
  EXPECT_EQ(crossings[0].back, 1) << "floor from below";
}

TEST(FaceWalk, LeavesAStraightSideByThePartThatItMeets) {
  const CellComplex complex = three_faces();  // face 0 is left by one side, of which two faces are beyond
  const FaceWeights weights = no_weights(complex);
  const FaceWalk walk(complex, weights);
  std::vector<Crossing> crossings;
  for (int i = 1; i < 20; ++i) {
    const double y = i == 10 ? 1.001 : 0.1 * i;
    walk.follow({{0.5, y, 1}, {1, 0, 0}, 0, 0}, crossings);
    ASSERT_EQ(crossings.size(), 2U) << y;
    EXPECT_NEAR(crossings[0].distance, 0.5, 1e-12) << y;
    EXPECT_EQ(crossings[1].cell, complex.cell(y < 1 ? 1 : 2, 0)) << y;
  }
}

TEST(FaceWalk, PointsLieInTheirFaceAndSpreadOverIt) {
  const CellComplex complex = grid_complex({0, 1, 3}, {0, 2}, {0, 3}, 0.4);
  const FaceWalk walk(complex, no_weights(complex));
  Vec2 sum(0, 0);
  const int n = 20;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      sum += walk.point_in(1, (i + 0.5) / n, (j + 0.5) / n);
    }
  }
  EXPECT_NEAR((sum / (n * n) - complex.centroid(1)).norm(), 0, 0.05);
}

}  // namespace
}  // namespace roomcut::raycast

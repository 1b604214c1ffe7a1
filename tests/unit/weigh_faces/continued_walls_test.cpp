// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/continued_walls.h"

#include <gtest/gtest.h>

#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::weigh_faces {
using namespace roomcut::raycast;

namespace {

/// The room west of x = 4 has a floor at 0, its neighbours one at 15 cm: of its wall a strip of 15 cm is a
/// layer of its own.
struct Step {
  CellComplex complex = grid_complex({-1, 0, 4, 4.2, 9}, {-1, 0, 4, 5}, {0, 0.15, 2.6});
  std::size_t edge = edge_near(complex, {4, 2});
  std::size_t low = complex.wall_face(edge, 0);
  std::size_t high = complex.wall_face(edge, 1);
  FaceWeights weights = no_weights(complex);

  explicit Step(std::uint32_t points_above) {
    weights.wall_omega[high] = 0.9F;
    weights.wall_left[high] = 0.9F;
    weights.wall_points[high] = points_above;
  }
  float continued() {
    continue_walls(complex, weights);
    return weights.wall_omega[low];
  }
  std::size_t level_west() const {
    return complex.level_face(static_cast<std::size_t>(complex.edges[edge].left), 1);
  }
};

TEST(ContinuedWalls, ThatExpectFewPointsAreCoveredAsTheWallAbove) {
  Step step(30);  // two in the strip
  EXPECT_GT(step.continued(), 0.5F);
  EXPECT_FLOAT_EQ(step.weights.wall_left[step.low], step.weights.wall_omega[step.low]);
  EXPECT_FLOAT_EQ(step.weights.wall_right[step.low], 0);
}

TEST(ContinuedWalls, ThatExpectManyPointsAreWhatWasSeen) {
  Step step(6000);
  EXPECT_LT(step.continued(), 0.02F);
}

TEST(ContinuedWalls, DoNotLoseWhatTheyHave) {
  Step step(30);
  step.weights.wall_omega[step.low] = step.weights.wall_right[step.low] = 0.8F;
  EXPECT_FLOAT_EQ(step.continued(), 0.8F);
  EXPECT_FLOAT_EQ(step.weights.wall_right[step.low], 0.8F);
}

TEST(ContinuedWalls, EndAtAFloorThatWasSeen) {
  Step step(30);
  step.weights.level_omega[step.level_west()] = 0.9F;
  EXPECT_EQ(step.continued(), 0);
}

TEST(ContinuedWalls, AreNotMadeOfAFewPointsNorInLayersThatTheLineDoesNotCarry) {
  Step few(5);
  EXPECT_EQ(few.continued(), 0);
  Step other(30);
  other.complex.lines[static_cast<std::size_t>(other.complex.edges[other.edge].line)].layers = {1};
  EXPECT_EQ(other.continued(), 0);
}

}  // namespace
}  // namespace roomcut::weigh_faces

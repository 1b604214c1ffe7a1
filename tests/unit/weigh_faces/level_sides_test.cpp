// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/level_sides.h"

#include <gtest/gtest.h>

#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::weigh_faces {
using namespace roomcut::raycast;

namespace {

/// Level 1 of three is covered in a hall of eight faces of the plan, and in another room.
struct Storeys {
  CellComplex complex =
      grid_complex({-1, 0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.2, 9}, {-1, 0, 4, 5}, {0, 2.7, 5.4});
  std::size_t hall = 12;  // the first of the eight
  std::size_t other = 21;

  /// `of_hall`: beside each of its faces.
  double floor_in_hall(const LevelSides& of_hall, const LevelSides& of_other) const {
    FaceWeights weights = no_weights(complex);
    std::vector<LevelSides> sides(complex.faces());
    for (std::size_t face = hall; face < hall + 8; ++face) {
      weights.level_omega[complex.level_face(face, 1)] = 0.9F;
      sides[face] = of_hall;
    }
    weights.level_omega[complex.level_face(other, 1)] = 0.9F;
    sides[other] = of_other;
    return floor_probability(complex, weights, 1, sides)[hall];
  }
};

TEST(FloorProbability, AFewStepsOfAStairMakeNoFloorWhereTheStoreyHasItsCeiling) {
  const Storeys storeys;
  EXPECT_LT(storeys.floor_in_hall({2, 0, 0, 0}, {60, 3400, 0, 0}), 0.3);
  EXPECT_GT(storeys.floor_in_hall({2, 0, 0, 0}, {0, 0, 0, 0}), 0.9) << "nothing else is known of the level";
}

TEST(FloorProbability, ARoomWithAFloorThereHasOneWhateverTheOthersHave) {
  EXPECT_GT(Storeys().floor_in_hall({20, 1, 0, 0}, {60, 3400, 0, 0}), 0.9);
}

TEST(FloorProbability, IsEvenWithoutEvidence) {
  EXPECT_DOUBLE_EQ(Storeys().floor_in_hall({0, 0, 0, 0}, {0, 0, 0, 0}), 0.5);
}

}  // namespace
}  // namespace roomcut::weigh_faces

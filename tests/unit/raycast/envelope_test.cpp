// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/envelope.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::raycast {
namespace {

/// A grid of 5 x 4 faces; rooms are the faces of the middle 3 x 2, of which the last one was not entered.
struct Plan {
  CellComplex complex = weigh_faces::grid_complex({-2, 0, 4, 8, 12, 14}, {-2, 0, 5, 10, 12}, {0, 3});
  std::vector<bool> empty = std::vector<bool>(complex.cells(), false);
  std::vector<std::uint8_t> indoors = std::vector<std::uint8_t>(complex.cells(), 0);
  static constexpr std::size_t kCorner = 13;  // x 8 … 12, y 5 … 10

  Plan() {
    for (const std::size_t face : {6, 7, 8, 11, 12}) {
      empty[face] = true;
      indoors[face] = 1;
    }
  }
  std::vector<double> beyond() const { return beyond_envelope(complex, weights_of(complex, empty), indoors); }
};

TEST(Envelope, ACornerRoomNobodyEnteredLiesWithinAndTheGardenBeyond) {
  const std::vector<double> beyond = Plan().beyond();
  EXPECT_EQ(beyond[Plan::kCorner], 0);
  EXPECT_EQ(beyond[7], 0);
  EXPECT_NEAR(beyond[9], 1, 1e-9);   // x 12 … 14, its middle 1 m beyond
  EXPECT_NEAR(beyond[17], 1, 1e-9);  // y 10 … 12
}

TEST(Envelope, WithoutAnythingIndoorsNothingLiesBeyond) {
  Plan plan;
  plan.indoors.assign(plan.complex.cells(), 0);
  for (const double far : plan.beyond()) {
    EXPECT_EQ(far, 0);
  }
}

TEST(Envelope, ItsDirectionsAreThoseOfTheWalls) {
  const Plan plan;
  const std::vector<Vec2> directions = wall_directions(plan.complex, weights_of(plan.complex, plan.empty));
  ASSERT_EQ(directions.size(), 2U);
  EXPECT_NEAR(directions[0].dot(directions[1]), 0, 1e-9);
  EXPECT_NEAR(std::abs(directions[0].x()) + std::abs(directions[0].y()), 1, 1e-9);
}

TEST(Envelope, WithoutWallsThereAreNoDirections) {
  const Plan plan;
  EXPECT_TRUE(wall_directions(plan.complex, no_weights(plan.complex)).empty());
}

}  // namespace
}  // namespace roomcut::raycast

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/wall_strips.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::raycast {
namespace {

/// Two rows of three rooms, y 0 … 4 and 4.2 … 8, with a wall of 20 cm between them, its middle piece of two
/// metres' length. The evidence is that of the cells' own faces; floor and ceiling are seen in what is empty.
struct Rows {
  CellComplex complex = weigh_faces::grid_complex({-1, 0, 4, 6, 10, 11}, {-1, 0, 4, 4.2, 8, 9}, {0, 3});
  std::vector<bool> empty = std::vector<bool>(complex.cells(), false);
  static constexpr std::size_t kLeft = 11, kMiddle = 12, kRight = 13;  // of the wall

  explicit Rows(bool door) {
    for (const std::size_t face : {6, 7, 8, 16, 17, 18}) {
      empty[face] = true;
    }
    empty[kMiddle] = door;
  }

  /// With the middle of the wall hidden from both sides.
  std::vector<double> hidden_middle(bool hide = true) const {
    FaceWeights weights = weights_of(complex, empty);
    for (const std::int32_t edge : complex.edges_of(kMiddle)) {
      for (std::vector<float>* of : {&weights.wall_omega, &weights.wall_left, &weights.wall_right}) {
        if (hide) (*of)[static_cast<std::size_t>(edge)] = 0;
      }
    }
    std::vector<CellEvidence> evidence(complex.cells());
    for (std::size_t c = 0; c < evidence.size(); ++c) {
      evidence[c].total_m2 = 1;
      evidence[c].upright.fronts = empty[c] ? 1 : 0;
    }
    return walls_that_go_on(complex, weights, evidence);
  }
};

TEST(WallStrips, AWallGoesOnWhereNobodySawIt) {
  EXPECT_GT(Rows(false).hidden_middle()[Rows::kMiddle], 0.9);
}

TEST(WallStrips, WhereItWasSeenNothingNeedsToBeSaid) {
  const std::vector<double> goes_on = Rows(false).hidden_middle();
  EXPECT_LT(goes_on[Rows::kLeft], 0.01);
  EXPECT_LT(Rows(false).hidden_middle(false)[Rows::kMiddle], 0.01);
}

TEST(WallStrips, ADoorwayIsSeenAndIsNone) {
  EXPECT_LT(Rows(true).hidden_middle()[Rows::kMiddle], 0.01);
}

TEST(WallStrips, RoomsAreTooWideToBeWalls) {
  const std::vector<double> goes_on = Rows(false).hidden_middle();
  EXPECT_EQ(goes_on[7], 0);
  EXPECT_EQ(goes_on[17], 0);
}

}  // namespace
}  // namespace roomcut::raycast

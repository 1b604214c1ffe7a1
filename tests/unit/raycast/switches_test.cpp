// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "stages/raycast/raycast.h"
#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::raycast {
namespace {

using weigh_faces::grid_complex;

/// A cell of 4 × 4 × 2 m whose floor alone is covered.
struct FloorOnly {
  CellComplex complex = grid_complex({0, 4}, {0, 4}, {0, 2});
  FaceWeights weights = [this] {
    FaceWeights w = no_weights(complex);
    w.level_omega[complex.level_face(0, 0)] = 1;
    w.level_floor[complex.level_face(0, 0)] = 1;
    return w;
  }();
};

double kappa(const FloorOnly& scene, const RaycastParams& params) {
  return cast_rays(scene.complex, scene.weights, params).kappa[0];
}

TEST(Switches, RaysFromTheCentreHitTheFloorWithTheSolidAngleThatItHasThere) {
  RaycastParams params;
  params.evidence = "parity";
  params.rays = 4096;
  params.level_rays = false;
  params.origins = "centre";
  // A square of half edge a at distance h covers 4 asin(a² / (a² + h²)) of 4 pi.
  EXPECT_NEAR(kappa({}, params), std::asin(4.0 / 5.0) / std::numbers::pi, 0.005);
  const double from_centre = kappa({}, params);
  params.origins = "spread";
  EXPECT_GT(std::abs(kappa({}, params) - from_centre), 0.01);
}

TEST(Switches, WithoutLevelRaysTwiceAsManySeeTheFloor) {
  RaycastParams params;
  params.evidence = "parity";
  params.rays = 4096;
  const double half = kappa({}, params);
  params.level_rays = false;
  EXPECT_NEAR(kappa({}, params), 2 * half, 0.01);
}

TEST(Switches, WithoutLevelRaysAClosedRoomIsNotTakenForAnOpenPlace) {
  const CellComplex complex = grid_complex({-2, 0, 4, 6}, {-2, 0, 4, 6}, {-1, 0, 2.5, 4});
  std::vector<bool> empty(complex.cells(), false);
  const std::size_t room = complex.cell(4, 1);
  empty[room] = true;
  const FaceWeights weights = weights_of(complex, empty);
  RaycastParams params;
  params.level_rays = false;
  for (const int rays : {2, 64}) {
    params.rays = rays;
    const DataTerms terms = cast_rays(complex, weights, params);
    EXPECT_NEAR(feature(terms, "open")[room], 0, 1e-6) << rays;
    EXPECT_GT(terms.beta[room], 0.95) << rays;
  }
}

TEST(Switches, WithoutImpliedFacesNoUnseenSideIsFree) {
  // A room whose wall of 10 cm at x = 4 was seen from inside only.
  const CellComplex complex = grid_complex({0, 4, 4.1, 6}, {0, 4}, {0, 2.5});
  std::vector<bool> empty(complex.cells(), false);
  empty[complex.cell(0, 0)] = true;
  const FaceWeights weights = weights_of(complex, empty);
  RaycastParams params;
  const auto most = [&] {
    const DataTerms terms = cast_rays(complex, weights, params);
    return *std::max_element(terms.wall_implied.begin(), terms.wall_implied.end());
  };
  EXPECT_GT(most(), 0.5F);
  params.implied_faces = false;
  EXPECT_EQ(most(), 0.0F);
}

}  // namespace
}  // namespace roomcut::raycast

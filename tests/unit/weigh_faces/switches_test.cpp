// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "stages/weigh_faces/weigh_faces.h"
#include "tests/unit/weigh_faces/grid_complex.h"
#include "tests/unit/weigh_faces/sampled_cloud.h"

namespace roomcut::weigh_faces {
namespace {

/// One room of 4 × 4 × 2.6 m inside the box.
CellComplex room(const std::vector<double>& levels = {0, 2.6}) {
  return grid_complex({-1, 0, 4, 5}, {-1, 0, 4, 5}, levels);
}

FaceWeights weigh(const CellComplex& complex, const SampledCloud& cloud, const WeighFacesParams& params) {
  FaceWeigher weigher(complex, cloud.header(), params);
  weigher.add(cloud.tile);
  return weigher.weigh();
}

WeighFacesParams without(bool WeighFacesParams::*addition) {
  WeighFacesParams params;
  params.*addition = false;
  return params;
}

float west(const CellComplex& complex, const FaceWeights& weights, std::size_t layer = 0) {
  return weights.wall_omega[complex.wall_face(edge_near(complex, {0, 2}), layer)];
}

TEST(Switches, InBinsOfTheEdgeAStripOfAWallCoversAllOfIt) {
  const CellComplex complex = room();
  SampledCloud cloud(400, 0.004);
  cloud.wall({0, 0}, {0, 4}, 0.5, 1.0);
  WeighFacesParams params;
  params.top_share = 0;
  EXPECT_NEAR(west(complex, weigh(complex, cloud, params)), 0.5 / 2.6, 0.05);
  params.wall_bins = "edge";
  EXPECT_GT(west(complex, weigh(complex, cloud, params)), 0.98);
}

TEST(Switches, WithoutTheCorrectionAThinSampleCoversItsBinsAlone) {
  const CellComplex complex = room();
  SampledCloud cloud(400, 0.004);
  cloud.keep = [](const Vec3& p) { return p.y() < 2 ? 1.0 : 0.15; };
  cloud.wall({0, 0}, {0, 4}, 0, 2.6);
  cloud.flat(0, 4, 0, 4, 0);
  const FaceWeights corrected = weigh(complex, cloud, {});
  const FaceWeights counted = weigh(complex, cloud, without(&WeighFacesParams::correct_density));
  EXPECT_GT(west(complex, corrected), 0.9);
  EXPECT_LT(west(complex, counted), 0.75);
  EXPECT_GT(corrected.level_omega[complex.level_face(4, 0)], 0.9);
  EXPECT_LT(counted.level_omega[complex.level_face(4, 0)], 0.75);
}

TEST(Switches, WithoutContinuedWallsAFaceThatNoPointHitStaysUncovered) {
  const CellComplex complex = room({0, 0.1, 2.6});
  SampledCloud cloud(100, 0.004);
  cloud.keep = [](const Vec3& p) { return p.z() < 0.1 && std::abs(p.x()) < 0.05 ? 0.0 : 1.0; };
  cloud.room(0, 4, 0, 4, 0, 2.6);
  EXPECT_GT(west(complex, weigh(complex, cloud, {})), 0);
  EXPECT_EQ(west(complex, weigh(complex, cloud, without(&WeighFacesParams::continue_walls))), 0);
}

TEST(Switches, WithoutSeenThroughAPaneBehindAWallKeepsItsCoverage) {
  const CellComplex complex = grid_complex({-1, 0, 4, 4.3, 5}, {-1, 0, 4, 5}, {0, 2.6});
  SampledCloud cloud(1000, 0.004);
  cloud.room(0, 4, 0, 4, 0, 2.6);
  for (const double z : {0.0, 2.6}) cloud.flat(4.15, 4.3, 0, 4, z);  // the sill and the head of its windows
  cloud.keep = [](const Vec3&) { return 0.05; };
  cloud.wall({4.3, 0}, {4.3, 4}, 0, 2.6);
  const std::size_t pane = complex.wall_face(edge_near(complex, {4.3, 2}), 0);
  const float discounted = weigh(complex, cloud, {}).wall_omega[pane];
  const float kept = weigh(complex, cloud, without(&WeighFacesParams::seen_through)).wall_omega[pane];
  EXPECT_GT(kept, 0.5);
  EXPECT_LT(discounted, 0.5F * kept);
}

TEST(Switches, WithoutSlopesARoofCoversNoLevel) {
  const CellComplex complex = room();
  SampledCloud cloud(400, 0.004);
  cloud.flat(0, 4, 0, 4, 0);
  for (int i = 0; i < 4000; ++i) {
    cloud.point({0.1 + 0.0475 * (i % 80), 0.1 + 0.076 * (i / 80), 2.55}, SurfaceClass::kSloped, 0);
  }
  const std::size_t ceiling = complex.level_face(4, 1);
  EXPECT_GT(weigh(complex, cloud, {}).level_omega[ceiling], 0.5);
  EXPECT_EQ(weigh(complex, cloud, without(&WeighFacesParams::slopes)).level_omega[ceiling], 0);
}

TEST(Switches, WithoutSidesBothSidesOfEveryFaceAreAlike) {
  const CellComplex complex = room();
  SampledCloud cloud(400, 0.004);
  cloud.room(0, 4, 0, 4, 0, 2.6);
  const std::size_t face = complex.wall_face(edge_near(complex, {0, 2}), 0);
  const FaceWeights known = weigh(complex, cloud, {});
  EXPECT_GT(std::abs(known.wall_left[face] - known.wall_right[face]), 0.5);
  const FaceWeights weights = weigh(complex, cloud, without(&WeighFacesParams::sides));
  EXPECT_EQ(weights.wall_omega, known.wall_omega);
  EXPECT_EQ(weights.wall_left, weights.wall_right);
  EXPECT_EQ(weights.level_floor, weights.level_ceiling);
  EXPECT_EQ(weights.wall_left[face], 0.5F * weights.wall_omega[face]);
}

}  // namespace
}  // namespace roomcut::weigh_faces

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/slopes.h"

#include <gtest/gtest.h>

#include "stages/weigh_faces/weigh_faces.h"
#include "tests/unit/weigh_faces/grid_complex.h"
#include "tests/unit/weigh_faces/sampled_cloud.h"

namespace roomcut::weigh_faces {
namespace {

/// A room 0 … 4 x 0 … 4 m whose ceiling rises from 2.4 m at x = 0 to 4 m at x = 4, as two steps at 2.8
/// and 3.6 m: strips 0 … 2 and 2 … 4, the riser at x = 2.
CellComplex monopitch(bool ceiling = true) {
  CellComplex complex = grid_complex({-1, 0, 2, 4, 5}, {-1, 0, 4, 5}, {0, 2.8, 3.6, 4.4});
  complex.steps = {0, 1, 1, 0};
  SlopedPlane plane;
  plane.gradient = {0.4, 0};
  plane.c = 2.4;
  plane.ceiling = ceiling;
  plane.outline = {{0.1, 0.1}, {3.9, 0.1}, {3.9, 3.9}, {0.1, 3.9}};
  complex.planes = {plane};
  CellComplex::Line& crease =
      complex.lines[static_cast<std::size_t>(complex.edges[edge_near(complex, {2, 2})].line)];
  crease.plane = 0;
  crease.layers = {1};
  return complex;
}

void sample_plane(SampledCloud& cloud, double x0, double x1) {
  for (double x = x0 + 0.02; x < x1; x += 0.04) {
    for (double y = 0.02; y < 4; y += 0.04) {
      cloud.point({x, y, 2.4 + 0.4 * x}, SurfaceClass::kHorizontal, 0);
    }
  }
}

FaceWeights weigh(const CellComplex& complex, double x0, double x1) {
  SampledCloud cloud(600, 0.004);
  cloud.flat(0, 4, 0, 4, 0);
  sample_plane(cloud, x0, x1);
  FaceWeigher weigher(complex, cloud.header(), {});
  weigher.add(cloud.tile);
  return weigher.weigh();
}

TEST(Slopes, PointsOfAPlaneCoverTheTreadThatStandsForItAndNoOther) {
  const CellComplex complex = monopitch();
  const FaceWeights w = weigh(complex, 0, 4);
  const auto face_at = [&](double x) {
    const CellComplex::Edge& edge = complex.edges[edge_near(complex, {x, 2})];
    return static_cast<std::size_t>(x < 2 ? edge.right : edge.left);
  };
  const std::size_t low = face_at(0), high = face_at(4);
  EXPECT_GT(w.level_ceiling[complex.level_face(low, 1)], 0.9);
  EXPECT_GT(w.level_ceiling[complex.level_face(high, 2)], 0.9);
  EXPECT_LT(w.level_omega[complex.level_face(low, 2)], 0.05);
  EXPECT_LT(w.level_omega[complex.level_face(high, 1)], 0.05);
  EXPECT_LT(w.level_floor[complex.level_face(low, 1)], 0.05);
}

TEST(Slopes, ARiserIsCoveredAsItsTreadsAndEmptyOnItsUphillSide) {
  const CellComplex complex = monopitch();
  const std::size_t e = edge_near(complex, {2, 2});
  const bool left_uphill = complex.centroid(static_cast<std::size_t>(complex.edges[e].left)).x() > 2;
  const auto uphill = [&](const FaceWeights& w, std::size_t k) {
    return (left_uphill ? w.wall_left : w.wall_right)[complex.wall_face(e, k)];
  };
  const FaceWeights whole = weigh(complex, 0, 4);
  EXPECT_GT(uphill(whole, 1), 0.9);
  EXPECT_LT(uphill(whole, 0), 0.05) << "in layers where nothing rises";
  EXPECT_LT(uphill(whole, 2), 0.05);
  const FaceWeights half = weigh(complex, 0, 2);
  EXPECT_NEAR(uphill(half, 1), 0.5, 0.05);
  const CellComplex ramp = monopitch(false);
  EXPECT_LT(uphill(weigh(ramp, 0, 4), 1), 0.05) << "over a floor the lower side is empty";
}

}  // namespace
}  // namespace roomcut::weigh_faces

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/distance_colours.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/mesh/shapes.h"

namespace roomcut::evaluate {
namespace {

using test::box;

TEST(DistanceColours, TheCutUpModelIsTheSameSurfaceInSmallTriangles) {
  const TriangleMesh model = box({0, 0, 0}, {4, 3, 2});
  const TriangleMesh truth = box({0, 0, 0}, {4, 3, 2.03});
  const DistanceMesh display = measure_for_display(model, MeshTree(truth));
  EXPECT_NEAR(surface_area(display.mesh), surface_area(model), 1e-9);
  EXPECT_GT(display.mesh.triangles.size(), 5000U);
  ASSERT_EQ(display.distance_m.size(), display.mesh.vertices.size());
  EXPECT_NEAR(*std::max_element(display.distance_m.begin(), display.distance_m.end()), 0.03, 1e-12);
  EXPECT_NEAR(*std::min_element(display.distance_m.begin(), display.distance_m.end()), 0, 1e-12);
}

}  // namespace
}  // namespace roomcut::evaluate

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/page_points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace roomcut::report {
namespace {

/// Two level squares of 1 m, regions 0 and 1, at z = 0 and z = 2.
TriangleMesh two_squares() {
  TriangleMesh mesh;
  for (const double z : {0.0, 2.0}) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
      mesh.vertices.emplace_back(x, y, z);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.region.insert(mesh.region.end(), 2, z > 1 ? 1 : 0);
  }
  return mesh;
}

TEST(PagePoints, coordinates_come_back_within_half_a_step) {
  const std::vector<ThinPoint> points = {{{-3, 5, 1}, 2}, {{40.123, 5.5, 1.25}, 1}, {{17.7, 60.9, 9.03}, 0}};
  const PagePoints packed = pack_points(points, {});
  ASSERT_EQ(packed.xyz.size(), 9U);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double back =
          packed.low[axis] + packed.step[axis] * packed.xyz[3 * i + static_cast<std::size_t>(axis)];
      EXPECT_NEAR(back, points[i].at[axis], 0.51 * packed.step[axis]);
    }
    EXPECT_EQ(packed.surface[i], points[i].surface);
  }
  EXPECT_LT(packed.step.maxCoeff(), 0.001);  // under a millimetre for a building of 60 m
  EXPECT_TRUE(packed.distance.empty());
}

TEST(PagePoints, no_points_give_no_arrays) {
  EXPECT_TRUE(pack_points({}, nearest_of_model({}, two_squares())).xyz.empty());
}

TEST(PagePoints, distances_are_millimetres_from_the_nearest_triangle) {
  const TriangleMesh model = two_squares();
  const std::vector<ThinPoint> points = {{{0.5, 0.5, 0.012}, 1}, {{0.25, 0.5, 1.9}, 1}, {{0.5, 0.5, 1.0}, 1}};
  const PagePoints packed = pack_points(points, nearest_of_model(points, model));
  ASSERT_EQ(packed.distance.size(), 3U);
  EXPECT_EQ(packed.distance[0], 12);
  EXPECT_EQ(packed.distance[1], 100);
  EXPECT_EQ(packed.distance[2], 255);  // farther than the steps reach
}

TEST(PagePoints, a_region_has_the_root_mean_square_of_its_own_points) {
  const TriangleMesh model = two_squares();
  const std::vector<ThinPoint> points = {
      {{0.5, 0.5, 0.003}, 1}, {{0.6, 0.5, -0.004}, 1}, {{0.5, 0.5, 1.0}, 1}};
  const std::vector<float> rms = region_distances(nearest_of_model(points, model), model, 2);
  EXPECT_NEAR(rms[0], std::sqrt((9e-6 + 16e-6) / 2), 1e-6);
  EXPECT_TRUE(std::isnan(rms[1]));
}

}  // namespace
}  // namespace roomcut::report

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/samples.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/mesh/mesh_tree.h"
#include "tests/unit/mesh/shapes.h"

namespace roomcut::evaluate {
namespace {

using test::box;

TEST(Samples, LieOnTheirTrianglesAndCarryTheWholeArea) {
  const TriangleMesh mesh = box({0, 0, 0}, {3, 2, 1});
  double area = 0;
  for (const SurfaceSample& s : sample_surface(mesh, 0.1, 1)) {
    const auto t = static_cast<std::size_t>(s.triangle);
    EXPECT_LT(squared_distance(s.point, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)), 1e-28);
    area += s.area_m2;
  }
  EXPECT_NEAR(area, 22, 1e-9);
}

TEST(Samples, NoPlaceOfTheSurfaceIsFarFromASample) {
  TriangleMesh mesh;  // long and thin
  mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {10, 0.02, 0}};
  mesh.triangles = {{0, 1, 2}};
  const auto samples = sample_surface(mesh, 0.1, 1);
  for (int i = 0; i <= 100; ++i) {
    double nearest = 1e9;
    for (const SurfaceSample& s : samples)
      nearest = std::min(nearest, (s.point - Vec3(0.1 * i, 0, 0)).norm());
    EXPECT_LT(nearest, 0.1);
  }
}

TEST(Samples, DependOnTheSeedAloneAndCornersAreAmongThem) {
  const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  const auto a = sample_surface(mesh, 0.2, 1);
  const auto b = sample_surface(mesh, 0.2, 1);
  const auto c = sample_surface(mesh, 0.2, 2);
  ASSERT_EQ(a.size(), b.size());
  bool differs = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].point, b[i].point);
    differs = differs || a[i].point != c[i].point;
  }
  EXPECT_TRUE(differs);
  for (const Vec3& corner : mesh.vertices) {
    EXPECT_EQ(1,
              std::count_if(a.begin(), a.end(), [&](const SurfaceSample& s) { return s.point == corner; }));
  }
}

TEST(Samples, AreCountedBeforeTheyAreMade) {
  const TriangleMesh mesh = box({0, 0, 0}, {30, 20, 3});
  for (const double spacing : {0.1, 0.5, 7.0}) {
    const auto made = static_cast<double>(sample_surface(mesh, spacing, 1).size());
    EXPECT_GE(sample_count(mesh, spacing), made);
    EXPECT_LE(sample_count(mesh, spacing), made + 3 * 12);
  }
}

TEST(Samples, TheSpacingGrowsWithWhatTheBudgetAffords) {
  TriangleMesh mesh = box({0, 0, 0}, {3, 2, 1});
  EXPECT_EQ(affordable_spacing(mesh, 0.1, 1e6), 0.1);
  for (Vec3& p : mesh.vertices) p *= 1000;  // millimetres: 2.2e9 samples at 0.1 m
  const double spacing = affordable_spacing(mesh, 0.1, 1e5);
  EXPECT_LE(sample_surface(mesh, spacing, 1).size(), 100000U);
  EXPECT_GE(sample_surface(mesh, spacing, 1).size(), 20000U);
  mesh.vertices[0].x() = -4e5;  // a needle: long sides, little area
  EXPECT_LE(sample_surface(mesh, affordable_spacing(mesh, 0.1, 1e5), 1).size(), 100000U);
  EXPECT_GT(affordable_spacing(mesh, 0.1, 0), 1e5);  // ends all the same
}

}  // namespace
}  // namespace roomcut::evaluate

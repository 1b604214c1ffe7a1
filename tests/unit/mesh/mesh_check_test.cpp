// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/mesh_check.h"

#include <gtest/gtest.h>

#include "common/mesh/self_intersections.h"
#include "tests/unit/mesh/shapes.h"

namespace roomcut {
namespace {

using test::append;
using test::box;

TEST(MeshCheck, ABoxIsValidWithEulerNumberTwo) {
  const MeshCheck check = check_mesh(box({0, 0, 0}, {1, 2, 3}));
  EXPECT_TRUE(check.valid()) << describe_faults(check);
  EXPECT_EQ(check.euler, 2);
  EXPECT_EQ(check.edges, 18);
  EXPECT_EQ(check.components, 1);
  EXPECT_NEAR(check.volume_m3, 6, 1e-12);
  EXPECT_EQ(describe_faults(check), "");
}

TEST(MeshCheck, AMissingTriangleLeavesThreeOpenEdges) {
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.pop_back();
  const MeshCheck check = check_mesh(mesh);
  EXPECT_EQ(check.open_edges, 3);
  EXPECT_FALSE(check.closed());
  EXPECT_FALSE(check.valid());
}

TEST(MeshCheck, ATurnedTriangleIsMisoriented) {
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  EXPECT_EQ(check_mesh(mesh).misoriented_edges, 3);
}

TEST(MeshCheck, BoxesThatShareAnEdgeOrACornerAreNotManifold) {
  TriangleMesh edge = box({0, 0, 0}, {1, 1, 1});
  append(edge, box({1, 1, 0}, {2, 2, 1}));
  const MeshCheck on_edge = check_mesh(weld_vertices(edge));
  EXPECT_EQ(on_edge.nonmanifold_edges, 1);
  EXPECT_EQ(on_edge.self_intersections, -1);
  TriangleMesh corner = box({0, 0, 0}, {1, 1, 1});
  append(corner, box({1, 1, 1}, {2, 2, 2}));
  const MeshCheck on_corner = check_mesh(weld_vertices(corner));
  EXPECT_EQ(on_corner.nonmanifold_edges, 0);
  EXPECT_EQ(on_corner.nonmanifold_vertices, 1);
  EXPECT_TRUE(on_corner.closed());
}

TEST(MeshCheck, OverlappingBoxesIntersectThemselvesAndNestedOnesDoNot) {
  TriangleMesh overlapping = box({0, 0, 0}, {1, 1, 1});
  append(overlapping, box({.5, .5, .5}, {2, 2, 2}));
  EXPECT_GT(check_mesh(overlapping).self_intersections, 0);
  TriangleMesh nested = box({0, 0, 0}, {3, 3, 3});
  TriangleMesh pillar = box({1, 1, 1}, {2, 2, 2});
  flip_orientation(pillar);
  append(nested, pillar);
  const MeshCheck check = check_mesh(nested);
  EXPECT_TRUE(check.valid()) << describe_faults(check);
  EXPECT_EQ(check.components, 2);
  EXPECT_NEAR(check.volume_m3, 26, 1e-12);
}

TEST(MeshCheck, TheTrianglesThatCutOthersAreNamed) {
  TriangleMesh mesh;  // two that cross, and one apart
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1},
                   {1, 2, 1}, {9, 0, 0}, {9, 1, 0}, {8, 0, 0}};
  mesh.triangles = {{6, 7, 8}, {0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(self_intersecting_triangles(mesh), (std::vector<std::size_t>{1, 2}));
  EXPECT_TRUE(self_intersecting_triangles(box({0, 0, 0}, {1, 1, 1})).empty());
}

TEST(MeshCheck, ATriangleWithoutAreaIsReported) {
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.vertices.emplace_back(.5, 0, 0);
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_EQ(check_mesh(mesh).degenerate_triangles, 1);
}

}  // namespace
}  // namespace roomcut

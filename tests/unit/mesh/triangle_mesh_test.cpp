// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include "tests/unit/mesh/shapes.h"

namespace roomcut {
namespace {

using test::append;
using test::box;

TEST(TriangleMesh, VolumeAndAreaOfABoxAreExactFarFromTheOrigin) {
  const Vec3 far(6e6, -5e5, 100);
  const TriangleMesh mesh = box(far, far + Vec3(2, 3, 4));
  EXPECT_NEAR(volume(mesh), 24, 1e-7);
  EXPECT_NEAR(surface_area(mesh), 52, 1e-7);
}

TEST(TriangleMesh, TurningAMeshAroundMakesItsVolumeNegative) {
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  flip_orientation(mesh);
  EXPECT_NEAR(volume(mesh), -1, 1e-12);
}

TEST(TriangleMesh, WeldingJoinsEqualVerticesAndKeepsTheirOrder) {
  TriangleMesh soup;
  const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      soup.vertices.push_back(mesh.corner(t, c));
    }
    const auto first = static_cast<std::int32_t>(3 * t);
    soup.triangles.push_back({first, first + 1, first + 2});
    soup.region.push_back(static_cast<std::int32_t>(t));
  }
  const TriangleMesh welded = weld_vertices(soup);
  EXPECT_EQ(welded.vertices.size(), 8U);
  EXPECT_EQ(welded.triangles.size(), 12U);
  EXPECT_EQ(welded.region.size(), 12U);
  EXPECT_EQ(welded.vertices.front(), soup.vertices.front());
  EXPECT_NEAR(volume(welded), 1, 1e-12);
}

TEST(TriangleMesh, WeldingDropsTrianglesThatLoseACorner) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 3}, {0, 1, 2}};
  mesh.kind = {1, 2};
  const TriangleMesh welded = weld_vertices(mesh);
  ASSERT_EQ(welded.triangles.size(), 1U);
  EXPECT_EQ(welded.kind, std::vector<std::uint8_t>{2});
  EXPECT_EQ(welded.vertices.size(), 3U);
}

TEST(TriangleMesh, ComponentsAreNumberedByTheirFirstTriangle) {
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  append(mesh, box({3, 0, 0}, {4, 1, 1}));
  const auto component = connected_components(mesh);
  EXPECT_EQ(component.front(), 0);
  EXPECT_EQ(component.back(), 1);
}

}  // namespace
}  // namespace roomcut

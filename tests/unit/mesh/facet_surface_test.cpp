// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/facet_surface.h"

#include <gtest/gtest.h>

#include "common/mesh/mesh_check.h"

namespace roomcut {
namespace {

// The surface of a box of n x n x n unit cubes, one square facet per cube side; planes and lines named by
// their place.
FacetSurface cubes(int n) {
  FacetSurface surface;
  const int m = n + 1;
  const auto vertex = [m](int x, int y, int z) { return (z * m + y) * m + x; };
  for (int z = 0; z < m; ++z) {
    for (int y = 0; y < m; ++y) {
      for (int x = 0; x < m; ++x) {
        surface.vertices.emplace_back(x, y, z);
      }
    }
  }
  // An edge's line: its axis and the two coordinates that stay the same.
  const auto line = [m](int axis, int i, int j) { return std::int64_t{(axis * m + i) * m + j}; };
  const auto square = [&](const std::array<std::array<int, 3>, 4>& c, std::int64_t plane) {
    std::vector<std::int32_t> corners;
    std::vector<std::int64_t> carriers;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& a = c[i];
      const auto& b = c[(i + 1) % 4];
      corners.push_back(vertex(a[0], a[1], a[2]));
      carriers.push_back(a[0] != b[0]   ? line(0, a[1], a[2])
                         : a[1] != b[1] ? line(1, a[0], a[2])
                                        : line(2, a[0], a[1]));
    }
    surface.add(corners, carriers, plane, SurfaceKind::kWall, 0);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      square({{{i, j, 0}, {i, j + 1, 0}, {i + 1, j + 1, 0}, {i + 1, j, 0}}}, 0);
      square({{{i, j, n}, {i + 1, j, n}, {i + 1, j + 1, n}, {i, j + 1, n}}}, 1);
      square({{{i, 0, j}, {i + 1, 0, j}, {i + 1, 0, j + 1}, {i, 0, j + 1}}}, 2);
      square({{{i, n, j}, {i, n, j + 1}, {i + 1, n, j + 1}, {i + 1, n, j}}}, 3);
      square({{{0, i, j}, {0, i, j + 1}, {0, i + 1, j + 1}, {0, i + 1, j}}}, 4);
      square({{{n, i, j}, {n, i + 1, j}, {n, i + 1, j + 1}, {n, i, j + 1}}}, 5);
    }
  }
  return surface;
}

TEST(FacetSurface, ABoxOfManyFacetsBecomesTwelveTriangles) {
  const MergedSurface merged = merge_facets(cubes(5));
  EXPECT_EQ(merged.fault, "");
  EXPECT_EQ(merged.regions.size(), 6U);
  EXPECT_EQ(merged.mesh.vertices.size(), 8U);
  EXPECT_EQ(merged.mesh.triangles.size(), 12U);
  const MeshCheck check = check_mesh(merged.mesh);
  EXPECT_TRUE(check.valid()) << describe_faults(check);
  EXPECT_NEAR(check.volume_m3, 125, 1e-12);
  for (const SurfaceRegion& region : merged.regions) {
    EXPECT_EQ(region.polygons.size(), 1U);
  }
}

TEST(FacetSurface, ADifferentStoreySplitsAPlaneButNotTheMesh) {
  FacetSurface surface = cubes(3);
  for (std::size_t f = 0; f < surface.facets(); ++f) {
    const auto& corner = surface.vertices[static_cast<std::size_t>(surface.corners[4 * f])];
    const auto& opposite = surface.vertices[static_cast<std::size_t>(surface.corners[4 * f + 2])];
    surface.storey[f] = std::min(corner.z(), opposite.z()) >= 1 ? 1 : 0;
  }
  const MergedSurface merged = merge_facets(surface);
  EXPECT_EQ(merged.regions.size(), 10U);
  EXPECT_EQ(merged.mesh.vertices.size(), 12U);
  const MeshCheck check = check_mesh(merged.mesh);
  EXPECT_TRUE(check.valid()) << describe_faults(check);
}

TEST(FacetSurface, AVertexBesideTheStraightLineIsKept) {
  FacetSurface surface = cubes(2);
  surface.vertices[1].y() -= 1e-6;  // middle of the edge from (0,0,0) to (2,0,0)
  EXPECT_EQ(merge_facets(surface).mesh.vertices.size(), 9U);
  EXPECT_EQ(merge_facets(surface, 1e-5).mesh.vertices.size(), 8U);
  EXPECT_TRUE(check_mesh(merge_facets(surface).mesh).valid());
}

TEST(FacetSurface, AnOpenSurfaceStaysOpenInsteadOfFailing) {
  FacetSurface surface = cubes(2);
  surface.offset.pop_back();
  surface.plane.pop_back();
  surface.kind.pop_back();
  surface.storey.pop_back();
  surface.corners.resize(static_cast<std::size_t>(surface.offset.back()));
  surface.carrier.resize(surface.corners.size());
  const MergedSurface merged = merge_facets(surface);
  EXPECT_EQ(merged.fault, "");
  EXPECT_GT(check_mesh(merged.mesh).open_edges, 0);
}

}  // namespace
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace roomcut {

/// A closed surface as many small planar facets that share whole edges (a conforming polygon mesh), each with
/// the name of the plane it lies in. The input of merge_facets().
struct FacetSurface {
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> offset{0};  ///< facets + 1, into `corners` and `carrier`
  std::vector<std::int32_t> corners;    ///< counter-clockwise seen from the normal's tip
  std::vector<std::int64_t>
      carrier;  ///< name of the straight line that the edge from this corner to the next lies on
  std::vector<std::int64_t> plane;   ///< per facet: name of its plane and side
  std::vector<std::uint8_t> kind;    ///< per facet: SurfaceKind
  std::vector<std::int16_t> storey;  ///< per facet

  std::size_t facets() const { return plane.size(); }
  /// Appends a facet; `facet_carriers[i]` belongs to the edge from corner i to corner i + 1.
  void add(const std::vector<std::int32_t>& facet_corners, const std::vector<std::int64_t>& facet_carriers,
           std::int64_t facet_plane, SurfaceKind facet_kind, std::int16_t facet_storey);
};

/// Signed volume that the facets enclose [m^3], each as a fan around its first corner.
double volume(const FacetSurface& surface);

/// A maximal connected surface of one plane, kind and storey.
struct SurfaceRegion {
  SurfaceKind kind = SurfaceKind::kOther;
  std::int16_t storey = 0;
  std::int64_t plane = 0;
  std::int32_t first_triangle = 0, triangles = 0;  ///< in MergedSurface::mesh
  std::vector<std::vector<std::int32_t>>
      polygons;  ///< the same surface as strictly convex polygons over mesh.vertices
};

struct MergedSurface {
  TriangleMesh mesh;  ///< with kind, storey and region
  std::vector<SurfaceRegion> regions;
  std::string fault;  ///< "" or why a region could not be triangulated (its triangles are then missing)
};

/// Joins facets of equal plane, kind and storey across their common edges and triangulates each region once.
/// The vertices kept are those where three regions meet or a boundary turns, everywhere the same ones: the
/// result is welded, without T-junctions and closed when the input is. Vertices that would be dropped but lie
/// more than `straight_m` beside the straight line between their neighbours are kept, too. Deterministic:
/// regions in order of their first facet.
MergedSurface merge_facets(const FacetSurface& surface, double straight_m = 1e-9);

}  // namespace roomcut

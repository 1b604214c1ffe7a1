// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace roomcut {

/// A planar surface with or without holes: its directed boundary segments, the surface lying on their left.
/// `points` are the exact coordinates of the corners in the plane (see project()); segments index them.
struct PlanarRegion {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 2>> segments;
};

/// Constrained Delaunay triangulation (CGAL, exact predicates) of the region's inside: counter-clockwise
/// triangles over `points`, no new points, sorted. Corners in the middle of a straight side are kept as
/// corners of triangles, never fanned over. Returns nullopt and the reason in `why` when segments cross or
/// are not closed loops.
std::optional<std::vector<Triangle>> triangulate(const PlanarRegion& region, std::string& why);

/// Triangles of one region joined across diagonals to strictly convex counter-clockwise polygons (Hertel and
/// Mehlhorn 1983: at most four times as many as the least number): every fan of such a polygon is a valid
/// triangulation.
std::vector<std::vector<std::int32_t>> convex_pieces(std::span<const Vec2> points,
                                                     std::span<const Triangle> triangles);

/// Exact projection along the axis in which the normal is largest: two of the three coordinates, in the order
/// that keeps counter-clockwise seen from the normal's tip.
struct Projection {
  int u = 0, v = 1;  ///< the coordinates kept
  Vec2 operator()(const Vec3& p) const { return {p[u], p[v]}; }
};
Projection project(const Vec3& normal);

/// Triangulates one simple polygon in space (corners in order, nearly planar), e.g. a face read from a file.
/// Falls back to nullopt as triangulate().
std::optional<std::vector<Triangle>> triangulate_polygon(std::span<const Vec3> corners, std::string& why);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut {

/// What a surface of the model is, seen from the empty space it bounds.
enum class SurfaceKind : std::uint8_t { kFloor = 0, kCeiling = 1, kWall = 2, kOther = 3 };

/// Lower-case word used in files and messages: "floor", "ceiling", "wall", "other".
const char* to_string(SurfaceKind kind);

using Triangle = std::array<std::int32_t, 3>;

/// An indexed triangle mesh [m]. Counter-clockwise seen from the side the normal points to. Meshes of empty
/// space have normals that point out of it, into the wall, so that their volume is positive.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  // Per triangle, or empty:
  std::vector<std::uint8_t> kind;    ///< SurfaceKind
  std::vector<std::int16_t> storey;  ///< 0 = lowest
  std::vector<std::int32_t> region;  ///< maximal coplanar surface that the triangle is part of

  /// Corner c (0, 1, 2) of a triangle.
  const Vec3& corner(std::size_t triangle, int c) const {
    return vertices[static_cast<std::size_t>(triangles[triangle][static_cast<std::size_t>(c)])];
  }
};

struct Bounds3 {
  Vec3 lo{0, 0, 0}, hi{0, 0, 0};
  double diagonal() const { return (hi - lo).norm(); }
};

/// Bounding box of the vertices; all zero for none.
Bounds3 bounds(const TriangleMesh& mesh);
/// Normal with twice the triangle's area as its length [m^2].
Vec3 area_normal(const TriangleMesh& mesh, std::size_t triangle);
double triangle_area(const TriangleMesh& mesh, std::size_t triangle);
/// Sum of the triangles' areas [m^2], in order of the triangles.
double surface_area(const TriangleMesh& mesh);
/// Signed volume of a closed mesh [m^3], summed relative to the bounding box's centre.
double volume(const TriangleMesh& mesh);

/// Joins vertices with exactly equal coordinates and drops unused ones; triangles that lose a corner are
/// removed. The first occurrence keeps its place in the order.
TriangleMesh weld_vertices(const TriangleMesh& mesh);
/// Component index per triangle; triangles that share a vertex index belong together. Numbered by first
/// triangle.
std::vector<std::int32_t> connected_components(const TriangleMesh& mesh);
/// Turns every triangle around.
void flip_orientation(TriangleMesh& mesh);

}  // namespace roomcut

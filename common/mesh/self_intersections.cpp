// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace roomcut {

namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
namespace pmp = CGAL::Polygon_mesh_processing;

std::vector<Point> points_of(const TriangleMesh& mesh) {
  std::vector<Point> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) {
    points.emplace_back(p.x(), p.y(), p.z());
  }
  return points;
}

/// Pairs of triangles, or nothing when they are no polygon mesh.
std::optional<std::vector<std::pair<std::size_t, std::size_t>>> intersecting_pairs(const TriangleMesh& mesh) {
  std::vector<std::array<std::size_t, 3>> corners;
  corners.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    corners.push_back(
        {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
  }
  if (!pmp::is_polygon_soup_a_polygon_mesh(corners)) {
    return std::nullopt;
  }
  CGAL::Surface_mesh<Point> surface;
  pmp::polygon_soup_to_polygon_mesh(points_of(mesh), corners, surface);
  using Face = CGAL::Surface_mesh<Point>::Face_index;
  std::vector<std::pair<Face, Face>> faces;
  pmp::self_intersections(surface, std::back_inserter(faces));
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [a, b] : faces) {
    pairs.emplace_back(a.idx(), b.idx());  // faces are made in the order of the triangles
  }
  return pairs;
}
}  // namespace

std::int64_t count_self_intersections(const TriangleMesh& mesh) {
  const auto pairs = intersecting_pairs(mesh);
  return pairs ? static_cast<std::int64_t>(pairs->size()) : -1;
}

std::vector<std::size_t> self_intersecting_triangles(const TriangleMesh& mesh) {
  std::vector<std::size_t> triangles;
  if (const auto pairs = intersecting_pairs(mesh)) {
    for (const auto& [a, b] : *pairs) {
      triangles.insert(triangles.end(), {a, b});
    }
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

std::int64_t count_degenerate_triangles(const TriangleMesh& mesh) {
  const auto points = points_of(mesh);
  std::int64_t count = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t c) { return points[static_cast<std::size_t>(t[c])]; };
    count += CGAL::collinear(corner(0), corner(1), corner(2)) ? 1 : 0;
  }
  return count;
}

}  // namespace roomcut

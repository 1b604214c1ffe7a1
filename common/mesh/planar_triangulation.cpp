// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/planar_triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace roomcut {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct FaceState {
  int inside = -1;  // -1 = not visited, 0 = outside, 1 = inside
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                CGAL::Triangulation_face_base_with_info_2<FaceState, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Cdt =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Segments = std::set<std::array<std::int32_t, 2>>;

std::vector<Cdt::Vertex_handle> insert_points(const PlanarRegion& region, Cdt& cdt) {
  std::vector<Cdt::Vertex_handle> handles;
  handles.reserve(region.points.size());
  Cdt::Face_handle hint;
  for (std::size_t i = 0; i < region.points.size(); ++i) {
    const Vec2& p = region.points[i];
    handles.push_back(cdt.insert({p.x(), p.y()}, hint));
    handles.back()->info() = static_cast<std::int32_t>(i);
    hint = handles.back()->face();
  }
  return handles;
}

// Spreads `inside` from face to face; a boundary segment says by its direction which side is inside.
// Returns false when two ways to a face disagree: the boundary is not a set of closed loops.
bool mark_inside(Cdt& cdt, const Segments& segments) {
  cdt.infinite_face()->info().inside = 0;
  std::vector<Cdt::Face_handle> open{cdt.infinite_face()};
  while (!open.empty()) {
    const Cdt::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Cdt::Face_handle next = face->neighbor(i);
      int inside = face->info().inside;
      if (face->is_constrained(i)) {
        const std::int32_t a = face->vertex(Cdt::ccw(i))->info();  // this face lies left of a -> b
        const std::int32_t b = face->vertex(Cdt::cw(i))->info();
        const bool here = segments.contains({a, b});
        const bool there = segments.contains({b, a});
        if (here != there) {
          if (here != (inside == 1)) {
            return false;
          }
          inside = there ? 1 : 0;
        }
      }
      if (next->info().inside < 0) {
        next->info().inside = inside;
        open.push_back(next);
      } else if (next->info().inside != inside) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

std::optional<std::vector<Triangle>> triangulate(const PlanarRegion& region, std::string& why) {
  Cdt cdt;
  const auto handles = insert_points(region, cdt);
  if (cdt.number_of_vertices() != region.points.size()) {
    why = "two corners of a planar region coincide";
    return std::nullopt;
  }
  if (cdt.dimension() < 2) {
    why = "a planar region has no area";
    return std::nullopt;
  }
  Segments segments;
  try {
    for (const auto& s : region.segments) {
      segments.insert(s);
      cdt.insert_constraint(handles[static_cast<std::size_t>(s[0])], handles[static_cast<std::size_t>(s[1])]);
    }
  } catch (const Cdt::Intersection_of_constraints_exception&) {
    why = "boundary segments of a planar region cross";
    return std::nullopt;
  }
  if (!mark_inside(cdt, segments)) {
    why = "the boundary of a planar region is not closed";
    return std::nullopt;
  }
  std::vector<Triangle> triangles;
  for (const auto face : cdt.finite_face_handles()) {
    if (face->info().inside == 1) {
      Triangle t{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      triangles.push_back(t);
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

Projection project(const Vec3& normal) {
  int dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  const int u = (dropped + 1) % 3;
  const int v = (dropped + 2) % 3;
  return normal[dropped] >= 0 ? Projection{u, v} : Projection{v, u};
}

std::optional<std::vector<Triangle>> triangulate_polygon(std::span<const Vec3> corners, std::string& why) {
  const std::size_t n = corners.size();
  if (n == 3) {
    return std::vector<Triangle>{{0, 1, 2}};
  }
  Vec3 normal{0, 0, 0};
  for (std::size_t i = 0; i < n; ++i) {  // Newell: twice the area vector
    const Vec3 a = corners[i] - corners[0];
    const Vec3 b = corners[(i + 1) % n] - corners[0];
    normal +=
        Vec3{a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
  }
  const Projection projection = project(normal);
  PlanarRegion region;
  for (std::size_t i = 0; i < n; ++i) {
    region.points.push_back(projection(corners[i]));
    region.segments.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>((i + 1) % n)});
  }
  return triangulate(region, why);
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/facet_surface.h"

#include <Eigen/Geometry>

#include <algorithm>

#include "common/mesh/facet_regions.h"
#include "common/mesh/planar_triangulation.h"

namespace roomcut {

namespace {

Vec3 facet_normal(const FacetSurface& surface, std::size_t facet) {
  const auto first = static_cast<std::size_t>(surface.offset[facet]);
  const auto last = static_cast<std::size_t>(surface.offset[facet + 1]);
  const auto point = [&](std::size_t i) {
    return surface.vertices[static_cast<std::size_t>(surface.corners[i])];
  };
  Vec3 normal{0, 0, 0};
  for (std::size_t i = first + 1; i + 1 < last; ++i) {
    const Vec3 u = point(i) - point(first);
    const Vec3 v = point(i + 1) - point(first);
    normal +=
        Vec3{u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x()};
  }
  return normal;
}

// Floors and ceilings are single-valued over the plan however they slope, and their corners exact there.
Vec3 region_normal(const FacetSurface& surface, std::size_t facet) {
  const auto kind = static_cast<SurfaceKind>(surface.kind[facet]);
  return kind == SurfaceKind::kFloor     ? Vec3(0, 0, -1)
         : kind == SurfaceKind::kCeiling ? Vec3(0, 0, 1)
                                         : facet_normal(surface, facet);
}

// The corners of one region, and its outline in the plane.
struct Outline {
  PlanarRegion planar;
  std::vector<std::int32_t> vertex;  // of the planar region's points
};

Outline outline_of(const FacetSurface& surface, const Projection& projection, const BorderSegment* first,
                   const BorderSegment* last) {
  Outline out;
  for (const BorderSegment* s = first; s != last; ++s) {
    out.vertex.insert(out.vertex.end(), s->ends.begin(), s->ends.end());
  }
  std::sort(out.vertex.begin(), out.vertex.end());
  out.vertex.erase(std::unique(out.vertex.begin(), out.vertex.end()), out.vertex.end());
  for (const std::int32_t v : out.vertex) {
    out.planar.points.push_back(projection(surface.vertices[static_cast<std::size_t>(v)]));
  }
  const auto local = [&](std::int32_t v) {
    return static_cast<std::int32_t>(std::lower_bound(out.vertex.begin(), out.vertex.end(), v) -
                                     out.vertex.begin());
  };
  for (const BorderSegment* s = first; s != last; ++s) {
    out.planar.segments.push_back({local(s->ends[0]), local(s->ends[1])});
  }
  return out;
}

// New numbers for the corners, in the order of the old ones; -1 for dropped vertices.
std::vector<std::int32_t> number_corners(const FacetSurface& surface, const std::vector<std::uint8_t>& corner,
                                         TriangleMesh& mesh) {
  std::vector<std::int32_t> number(surface.vertices.size(), -1);
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    if (corner[v] != 0) {
      number[v] = static_cast<std::int32_t>(mesh.vertices.size());
      mesh.vertices.push_back(surface.vertices[v]);
    }
  }
  return number;
}

template <class Corners>
Corners renumbered(const Corners& local, const Outline& outline, const std::vector<std::int32_t>& number) {
  Corners out = local;
  for (auto& v : out) {
    v = number[static_cast<std::size_t>(outline.vertex[static_cast<std::size_t>(v)])];
  }
  return out;
}

}  // namespace

void FacetSurface::add(const std::vector<std::int32_t>& facet_corners,
                       const std::vector<std::int64_t>& facet_carriers, std::int64_t facet_plane,
                       SurfaceKind facet_kind, std::int16_t facet_storey) {
  corners.insert(corners.end(), facet_corners.begin(), facet_corners.end());
  carrier.insert(carrier.end(), facet_carriers.begin(), facet_carriers.end());
  offset.push_back(static_cast<std::int32_t>(corners.size()));
  plane.push_back(facet_plane);
  kind.push_back(static_cast<std::uint8_t>(facet_kind));
  storey.push_back(facet_storey);
}

double volume(const FacetSurface& surface) {
  double six_volumes = 0;
  const auto vertex = [&](std::int32_t corner) -> const Vec3& {
    return surface.vertices[static_cast<std::size_t>(surface.corners[static_cast<std::size_t>(corner)])];
  };
  for (std::size_t f = 0; f < surface.facets(); ++f) {
    const Vec3 a = vertex(surface.offset[f]) - surface.vertices.front();  // cancels less than the origin does
    for (std::int32_t i = surface.offset[f] + 1; i + 1 < surface.offset[f + 1]; ++i) {
      const Vec3 b = vertex(i) - surface.vertices.front();
      const Vec3 c = vertex(i + 1) - surface.vertices.front();
      six_volumes += a.dot(b.cross(c));
    }
  }
  return six_volumes / 6;
}

MergedSurface merge_facets(const FacetSurface& surface, double straight_m) {
  const FacetRegions regions = join_facets(surface);
  const std::vector<std::uint8_t> corner = find_corners(surface, regions, straight_m);
  const std::vector<BorderSegment> segments = straighten(regions, corner);
  MergedSurface out;
  const std::vector<std::int32_t> number = number_corners(surface, corner, out.mesh);
  std::size_t first = 0;
  std::int32_t region = 0;
  for (std::size_t f = 0; f < surface.facets(); ++f) {
    if (regions.region_of[f] != region) {
      continue;  // regions are numbered by their first facets
    }
    std::size_t last = first;
    while (last < segments.size() && segments[last].region == region) {
      ++last;
    }
    const Outline outline = outline_of(surface, project(region_normal(surface, f)), segments.data() + first,
                                       segments.data() + last);
    std::string why;
    const auto triangles = triangulate(outline.planar, why);
    SurfaceRegion made{static_cast<SurfaceKind>(surface.kind[f]),
                       surface.storey[f],
                       surface.plane[f],
                       static_cast<std::int32_t>(out.mesh.triangles.size()),
                       0,
                       {}};
    if (triangles) {
      for (const Triangle& t : *triangles) {
        out.mesh.triangles.push_back(renumbered(t, outline, number));
      }
      made.triangles = static_cast<std::int32_t>(triangles->size());
      for (const auto& polygon : convex_pieces(outline.planar.points, *triangles)) {
        made.polygons.push_back(renumbered(polygon, outline, number));
      }
    } else if (out.fault.empty()) {
      out.fault = why;
    }
    out.mesh.kind.insert(out.mesh.kind.end(), static_cast<std::size_t>(made.triangles), surface.kind[f]);
    out.mesh.storey.insert(out.mesh.storey.end(), static_cast<std::size_t>(made.triangles),
                           surface.storey[f]);
    out.mesh.region.insert(out.mesh.region.end(), static_cast<std::size_t>(made.triangles), region);
    out.regions.push_back(std::move(made));
    first = last;
    ++region;
  }
  return out;
}

}  // namespace roomcut

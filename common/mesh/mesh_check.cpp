// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/mesh_check.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "common/mesh/self_intersections.h"

namespace roomcut {

namespace {

// One side of a triangle; corner c is where it starts.
struct Side {
  std::int32_t lo, hi;  // the edge's vertices
  std::int32_t corner;  // 3 * triangle + c
  bool forward;         // runs lo -> hi
  auto key() const { return std::pair(lo, hi); }
};

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int32_t a = mesh.triangles[t][c];
      const std::int32_t b = mesh.triangles[t][(c + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(3 * t + c), a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.key() != b.key() ? a.key() < b.key() : a.corner < b.corner;
  });
  return sides;
}

// Corners joined across the triangles' edges; the roots that stay apart at one vertex are its fans.
class Fans {
 public:
  explicit Fans(const TriangleMesh& mesh) : mesh_(mesh), parent_(3 * mesh.triangles.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  // Joins the corners of two triangles at both ends of the edge they share.
  void join(const Side& a, const Side& b) {
    unite(corner_at(a, a.lo), corner_at(b, a.lo));
    unite(corner_at(a, a.hi), corner_at(b, a.hi));
  }
  std::int64_t vertices_with_several() {
    constexpr std::int32_t kNone = -1;
    constexpr std::int32_t kSeveral = -2;
    std::vector<std::int32_t> fan(mesh_.vertices.size(), kNone);
    for (std::int32_t c = 0; c < static_cast<std::int32_t>(parent_.size()); ++c) {
      auto& known = fan[static_cast<std::size_t>(vertex(c))];
      const std::int32_t own = root(c);
      known = known == kNone || known == own ? own : kSeveral;
    }
    return std::count(fan.begin(), fan.end(), kSeveral);
  }

 private:
  std::int32_t vertex(std::int32_t corner) const {
    return mesh_.triangles[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>(corner % 3)];
  }
  std::int32_t corner_at(const Side& side, std::int32_t v) const {
    const std::int32_t next = side.corner - side.corner % 3 + (side.corner % 3 + 1) % 3;
    return vertex(side.corner) == v ? side.corner : next;
  }
  std::int32_t root(std::int32_t c) {
    while (parent_[static_cast<std::size_t>(c)] != c) {
      auto& up = parent_[static_cast<std::size_t>(c)];
      up = parent_[static_cast<std::size_t>(up)];
      c = up;
    }
    return c;
  }
  void unite(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

  const TriangleMesh& mesh_;
  std::vector<std::int32_t> parent_;
};

void count_connectivity(const TriangleMesh& mesh, MeshCheck& check) {
  const std::vector<Side> sides = sorted_sides(mesh);
  Fans fans(mesh);
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].key() == sides[first].key()) {
      fans.join(sides[first], sides[last]);
      ++last;
    }
    const std::size_t users = last - first;
    ++check.edges;
    check.open_edges += users == 1 ? 1 : 0;
    check.nonmanifold_edges += users > 2 ? 1 : 0;
    check.misoriented_edges += users == 2 && sides[first].forward == sides[first + 1].forward ? 1 : 0;
    first = last;
  }
  check.nonmanifold_vertices = fans.vertices_with_several();
}

}  // namespace

MeshCheck check_mesh(const TriangleMesh& mesh) {
  MeshCheck check;
  check.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  std::vector<std::uint8_t> used(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const auto v : t) {
      used[static_cast<std::size_t>(v)] = 1;
    }
  }
  check.vertices = std::count(used.begin(), used.end(), 1);
  count_connectivity(mesh, check);
  check.euler = check.vertices - check.edges + check.triangles;
  const auto component = connected_components(mesh);
  check.components = component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  check.area_m2 = surface_area(mesh);
  check.volume_m3 = volume(mesh);
  check.degenerate_triangles = count_degenerate_triangles(mesh);
  const bool cgal_can = check.manifold() && check.oriented() && check.degenerate_triangles == 0;
  check.self_intersections = cgal_can ? count_self_intersections(mesh) : -1;
  return check;
}

std::string describe_faults(const MeshCheck& check) {
  std::string text;
  const auto fault = [&text](std::int64_t count, const char* what) {
    if (count > 0) {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    }
  };
  if (check.triangles == 0) {
    text = "no triangles";
  }
  fault(check.open_edges, "open edges");
  fault(check.nonmanifold_edges, "edges with more than two triangles");
  fault(check.misoriented_edges, "edges with triangles of opposite orientation");
  fault(check.nonmanifold_vertices, "vertices where surfaces touch");
  fault(check.degenerate_triangles, "triangles without area");
  fault(check.self_intersections, "pairs of triangles that intersect");
  return text;
}

}  // namespace roomcut

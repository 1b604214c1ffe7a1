// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/triangle_mesh.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace roomcut {

const char* to_string(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::kFloor:
      return "floor";
    case SurfaceKind::kCeiling:
      return "ceiling";
    case SurfaceKind::kWall:
      return "wall";
    default:
      return "other";
  }
}

Bounds3 bounds(const TriangleMesh& mesh) {
  Bounds3 box;
  if (mesh.vertices.empty()) {
    return box;
  }
  box.lo = box.hi = mesh.vertices.front();
  for (const Vec3& p : mesh.vertices) {
    box.lo = box.lo.cwiseMin(p);
    box.hi = box.hi.cwiseMax(p);
  }
  return box;
}

Vec3 area_normal(const TriangleMesh& mesh, std::size_t triangle) {
  const Vec3& a = mesh.corner(triangle, 0);
  const Vec3 u = mesh.corner(triangle, 1) - a;
  const Vec3 v = mesh.corner(triangle, 2) - a;
  return {u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x()};
}

double triangle_area(const TriangleMesh& mesh, std::size_t triangle) {
  return 0.5 * area_normal(mesh, triangle).norm();
}

double surface_area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += triangle_area(mesh, t);
  }
  return sum;
}

double volume(const TriangleMesh& mesh) {
  const Bounds3 box = bounds(mesh);
  const Vec3 centre = 0.5 * (box.lo + box.hi);  // cancels less than the origin does
  double six_volumes = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    six_volumes += (mesh.corner(t, 0) - centre).dot(area_normal(mesh, t));
  }
  return six_volumes / 6;
}

TriangleMesh weld_vertices(const TriangleMesh& mesh) {
  const std::size_t n = mesh.vertices.size();
  std::vector<std::int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::int32_t i) {
    const Vec3& p = mesh.vertices[static_cast<std::size_t>(i)];
    return std::array<double, 3>{p.x(), p.y(), p.z()};
  };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const auto ka = key(a);
    const auto kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<std::int32_t> first(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool equals_previous = i > 0 && key(order[i]) == key(order[i - 1]);
    first[static_cast<std::size_t>(order[i])] =
        equals_previous ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  TriangleMesh out;
  std::vector<std::uint8_t> used(n, 0);
  std::vector<std::size_t> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle corners = mesh.triangles[t];
    for (auto& v : corners) {
      v = first[static_cast<std::size_t>(v)];
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      continue;
    }
    kept.push_back(t);
    out.triangles.push_back(corners);
    for (const auto v : corners) {
      used[static_cast<std::size_t>(v)] = 1;
    }
  }
  std::vector<std::int32_t> renumbered(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    if (used[i] != 0) {
      renumbered[i] = static_cast<std::int32_t>(out.vertices.size());
      out.vertices.push_back(mesh.vertices[i]);
    }
  }
  for (auto& corners : out.triangles) {
    for (auto& v : corners) {
      v = renumbered[static_cast<std::size_t>(v)];
    }
  }
  const auto pick = [&](const auto& from, auto& to) {
    if (!from.empty()) {
      for (const std::size_t t : kept) {
        to.push_back(from[t]);
      }
    }
  };
  pick(mesh.kind, out.kind);
  pick(mesh.storey, out.storey);
  pick(mesh.region, out.region);
  return out;
}

std::vector<std::int32_t> connected_components(const TriangleMesh& mesh) {
  std::vector<std::int32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t v) {
    while (parent[static_cast<std::size_t>(v)] != v) {
      auto& up = parent[static_cast<std::size_t>(v)];
      up = parent[static_cast<std::size_t>(up)];
      v = up;
    }
    return v;
  };
  for (const Triangle& t : mesh.triangles) {
    for (const int c : {1, 2}) {
      const std::int32_t a = root(t[0]);
      const std::int32_t b = root(t[static_cast<std::size_t>(c)]);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<std::int32_t> number(mesh.vertices.size(), -1);
  std::vector<std::int32_t> component;
  component.reserve(mesh.triangles.size());
  std::int32_t count = 0;
  for (const Triangle& t : mesh.triangles) {
    auto& own = number[static_cast<std::size_t>(root(t[0]))];
    if (own < 0) {
      own = count++;
    }
    component.push_back(own);
  }
  return component;
}

void flip_orientation(TriangleMesh& mesh) {
  for (Triangle& t : mesh.triangles) {
    std::swap(t[1], t[2]);
  }
}

}  // namespace roomcut

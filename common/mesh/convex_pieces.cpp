// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include "common/mesh/planar_triangulation.h"

namespace roomcut {

namespace {

using Polygon = std::vector<std::int32_t>;
using EdgeKey = std::array<std::int32_t, 2>;

// Whether the path a -> b -> c turns left by more than rounding can fake (about 2e-4 degrees).
bool turns_left(std::span<const Vec2> points, std::int32_t a, std::int32_t b, std::int32_t c) {
  const Vec2 u = points[static_cast<std::size_t>(b)] - points[static_cast<std::size_t>(a)];
  const Vec2 v = points[static_cast<std::size_t>(c)] - points[static_cast<std::size_t>(b)];
  constexpr double kLeastSine = 4e-6;
  return u.x() * v.y() - u.y() * v.x() > kLeastSine * u.norm() * v.norm();
}

std::size_t position(const Polygon& polygon, std::int32_t vertex) {
  return static_cast<std::size_t>(std::find(polygon.begin(), polygon.end(), vertex) - polygon.begin());
}

// The union of p (with edge a -> b) and q (with edge b -> a), or {} when a corner would not be strictly
// convex.
Polygon joined(std::span<const Vec2> points, const Polygon& p, const Polygon& q, const EdgeKey& edge) {
  const std::size_t ia = position(p, edge[0]);
  const std::size_t ib = position(q, edge[1]);
  Polygon out;
  for (std::size_t i = 1; i <= p.size(); ++i) {  // b … a
    out.push_back(p[(ia + i) % p.size()]);
  }
  for (std::size_t i = 2; i < q.size(); ++i) {  // after a, before b
    out.push_back(q[(ib + i) % q.size()]);
  }
  const std::size_t n = out.size();
  for (const std::size_t i : {std::size_t{0}, p.size() - 1}) {
    if (!turns_left(points, out[(i + n - 1) % n], out[i], out[(i + 1) % n])) {
      return {};
    }
  }
  return out;
}

}  // namespace

std::vector<std::vector<std::int32_t>> convex_pieces(std::span<const Vec2> points,
                                                     std::span<const Triangle> triangles) {
  std::vector<Polygon> polygons;
  std::map<EdgeKey, std::size_t> owner;  // directed edge -> polygon
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      owner[{t[c], t[(c + 1) % 3]}] = polygons.size();
    }
    polygons.emplace_back(t.begin(), t.end());
  }
  // Longest diagonals first: they cut off the thinnest pieces.
  std::vector<std::pair<double, EdgeKey>> diagonals;
  for (const auto& [edge, polygon] : owner) {
    if (edge[0] < edge[1] && owner.contains({edge[1], edge[0]})) {
      const Vec2 along =
          points[static_cast<std::size_t>(edge[1])] - points[static_cast<std::size_t>(edge[0])];
      diagonals.emplace_back(-along.squaredNorm(), edge);
    }
  }
  std::sort(diagonals.begin(), diagonals.end());
  for (const auto& [length, edge] : diagonals) {
    const std::size_t p = owner.at(edge);
    const std::size_t q = owner.at({edge[1], edge[0]});
    if (p == q) {
      continue;
    }
    Polygon both = joined(points, polygons[p], polygons[q], edge);
    if (both.empty()) {
      continue;
    }
    owner.erase(edge);
    owner.erase({edge[1], edge[0]});
    for (std::size_t i = 0; i < both.size(); ++i) {
      const auto found = owner.find({both[i], both[(i + 1) % both.size()]});
      found->second = p;
    }
    polygons[p] = std::move(both);
    polygons[q].clear();
  }
  std::erase_if(polygons, [](const Polygon& polygon) { return polygon.empty(); });
  return polygons;
}

}  // namespace roomcut

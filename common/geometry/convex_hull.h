// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut {

/// Twice the signed area of a closed ring: positive when it turns left.
inline double turned_area(const std::vector<Vec2>& ring) {
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - ring[0];
    const Vec2 b = ring[i + 1 < ring.size() ? i + 1 : 0] - ring[0];
    area += a.x() * b.y() - a.y() * b.x();
  }
  return area;
}

/// The convex hull, counter-clockwise from its smallest corner (by x, then y), without corners on its sides;
/// of points on one line or spot it has less than three corners. Depends on the points only, not on their
/// order.
inline std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return std::make_tuple(a.x(), a.y()) < std::make_tuple(b.x(), b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Vec2> hull;
  if (points.size() < 3) return hull;
  const auto add_chain = [&hull](auto from, auto to) {
    const std::size_t begin = hull.size();
    for (; from != to; ++from) {
      while (hull.size() >= begin + 2) {
        const Vec2 side = hull.back() - hull[hull.size() - 2];
        const Vec2 next = *from - hull.back();
        if (side.x() * next.y() - side.y() * next.x() > 0) break;
        hull.pop_back();
      }
      hull.push_back(*from);
    }
    hull.pop_back();
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace roomcut

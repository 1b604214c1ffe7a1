// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/dent.h"

#include <algorithm>

namespace roomcut::partition {

namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

double dent(std::vector<Vec2> corners) {
  const auto first = std::min_element(corners.begin(), corners.end(), [](const Vec2& p, const Vec2& q) {
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  });
  std::rotate(corners.begin(), first, corners.end());  // begins, and ends, at a corner of the hull
  corners.push_back(corners.front());
  std::vector<std::size_t> hull{0};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    while (hull.size() > 1) {
      const Vec2& last = corners[hull.back()];
      if (cross(last - corners[hull[hull.size() - 2]], corners[i] - last) > 0) {
        break;
      }
      hull.pop_back();
    }
    hull.push_back(i);
  }
  double deepest = 0;
  for (std::size_t side = 1; side < hull.size(); ++side) {
    const Vec2& from = corners[hull[side - 1]];
    const Vec2 along = corners[hull[side]] - from;
    for (std::size_t i = hull[side - 1] + 1; i < hull[side]; ++i) {
      deepest = std::max(deepest, cross(along, corners[i] - from) / along.norm());
    }
  }
  return deepest;
}

}  // namespace roomcut::partition

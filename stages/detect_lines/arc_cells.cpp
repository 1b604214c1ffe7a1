// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/arc_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>

namespace roomcut::detect_lines {
namespace {

constexpr double kTurn_rad = 25 * std::numbers::pi / 180;  // between neighbours
constexpr double kOffRow = 0.35;                           // of the squares' edge, from a neighbour's tangent

Vec2 position(const WallCells& cells, std::uint32_t i) {
  return {cells.x[i], cells.y[i]};
}

}  // namespace

double along(const Bend& bend, const Vec2& p) {
  const Vec2 from = (bend.curvature > 0 ? -1 : 1) * bend.normal;
  const Vec2 to = p - bend.centre();
  return bend.radius() * std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

CellSquares::CellSquares(const WallCells& cells, double edge_m) : cells_(cells), edge_(edge_m) {
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const auto [ix, iy] = square_of(position(cells, i));
    sorted_.emplace_back(key_of(ix, iy), i);
  }
  std::sort(sorted_.begin(), sorted_.end());
}

std::pair<std::int64_t, std::int64_t> CellSquares::square_of(const Vec2& p) const {
  return {static_cast<std::int64_t>(std::floor(p.x() / edge_)),
          static_cast<std::int64_t>(std::floor(p.y() / edge_))};
}

std::vector<std::pair<std::int64_t, std::uint32_t>>::const_iterator CellSquares::first_of(
    std::int64_t key) const {
  return std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(key, std::uint32_t{0}));
}

CellIndices CellSquares::along_circle(const Bend& bend, const Stretch& stretch, double reach_m) const {
  std::vector<std::int64_t> keys;
  const Vec2 centre = bend.centre();
  const Vec2 start = bend.point - centre;
  const double step = 0.5 * edge_;
  const auto steps = static_cast<int>(std::ceil(stretch.length() / step));
  for (int k = 0; k <= steps; ++k) {
    const double angle = (stretch.low + std::min(k * step, stretch.length())) / bend.radius();
    const Vec2 p = centre + Vec2(std::cos(angle) * start.x() - std::sin(angle) * start.y(),
                                 std::sin(angle) * start.x() + std::cos(angle) * start.y());
    const auto [ix, iy] = square_of(p);
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      for (std::int64_t dx = -1; dx <= 1; ++dx) keys.push_back(key_of(ix + dx, iy + dy));
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  CellIndices found;
  for (const std::int64_t key : keys) {
    for (auto it = first_of(key); it != sorted_.end() && it->first == key; ++it) {
      const Vec2 p = position(cells_, it->second);
      if (std::abs(bend.distance(p)) > reach_m) continue;
      const double at = along(bend, p);
      if (at >= stretch.low && at <= stretch.high) found.push_back(it->second);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

CellIndices CellSquares::chain(std::uint32_t seed, double reach_m) const {
  CellIndices found{seed};
  std::unordered_set<std::uint32_t> seen{seed};
  const Vec2 origin = position(cells_, seed);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::uint32_t from = found[k];
    const Vec2 p = position(cells_, from);
    const Vec2 normal = Line2{static_cast<double>(cells_.theta[from]), 0}.normal();
    near(p, [&](std::uint32_t i) {
      const Vec2 q = position(cells_, i);
      const bool fits = cells_.boundary[i] != 0 && (q - p).norm() <= edge_ &&
                        (q - origin).norm() <= reach_m && std::abs(normal.dot(q - p)) <= kOffRow * edge_ &&
                        angle_between(cells_.theta[i], cells_.theta[from]) <= kTurn_rad;
      if (fits && seen.insert(i).second) found.push_back(i);
    });
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace roomcut::detect_lines

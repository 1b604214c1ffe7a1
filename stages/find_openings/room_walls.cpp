// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/find_openings/room_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "common/cells/plan_walk.h"

namespace roomcut::find_openings {

namespace {

constexpr double kParallel_rad = 3.0 * std::numbers::pi / 180.0;
constexpr double kThinnest_m = 0.03;

using Key = std::tuple<std::int32_t, std::int32_t, int>;                           // line_a, line_b, side
using Places = std::map<Key, std::vector<std::pair<std::int64_t, std::int32_t>>>;  // column, layer

class Walker {
 public:
  Walker(const CellComplex& complex, const std::vector<std::uint8_t>& label, double max_thickness_m,
         double step_m)
      : complex_(complex), label_(label), max_m_(max_thickness_m), step_m_(step_m) {}

  Places walk_all() {
    for (const CellComplex::Edge& edge : complex_.edges) {
      if (!complex_.on_wall_line(edge) || edge.left < 0 || edge.right < 0) {
        continue;
      }
      const Line2& line = complex_.lines[static_cast<std::size_t>(edge.line)].line;
      const Vec2& p0 = complex_.vertices[static_cast<std::size_t>(edge.v0)];
      const Vec2& p1 = complex_.vertices[static_cast<std::size_t>(edge.v1)];
      const bool along = line.direction().dot(p1 - p0) > 0;  // then the normal points to the right
      walk_edge(edge, line, along ? edge.left : edge.right, along ? edge.right : edge.left, 1);
      walk_edge(edge, line, along ? edge.right : edge.left, along ? edge.left : edge.right, -1);
    }
    return std::move(places_);
  }

 private:
  bool empty(std::int32_t face, std::size_t layer) const { return is_empty(complex_, label_, face, layer); }

  /// From the room `outer` through the face `inner` behind the edge, towards side · normal.
  void walk_edge(const CellComplex::Edge& edge, const Line2& line, std::int32_t outer, std::int32_t inner,
                 int side) {
    start_.clear();
    for (std::size_t k = 0; k < complex_.layers(); ++k) {
      if (empty(outer, k) && !empty(inner, k)) {
        start_.push_back(k);
      }
    }
    if (start_.empty()) {
      return;
    }
    const auto [low, high] = std::minmax({line.along(complex_.vertices[static_cast<std::size_t>(edge.v0)]),
                                          line.along(complex_.vertices[static_cast<std::size_t>(edge.v1)])});
    const auto first = static_cast<std::int64_t>(std::ceil(low / step_m_ - 0.5));
    for (std::int64_t i = first; (static_cast<double>(i) + 0.5) * step_m_ < high; ++i) {
      walk_column(edge.line, line, inner, side, i);
    }
  }

  void walk_column(std::int32_t line_a, const Line2& line, std::int32_t face, int side, std::int64_t column) {
    const Vec2 from = line.at((static_cast<double>(column) + 0.5) * step_m_);
    const Vec2 direction = side * line.normal();
    open_ = start_;
    while (!open_.empty()) {
      const FaceExit exit = leave_face(complex_, static_cast<std::size_t>(face), from, direction);
      if (exit.edge < 0 || exit.distance > max_m_) {
        return;
      }
      const CellComplex::Edge& edge = complex_.edges[static_cast<std::size_t>(exit.edge)];
      face = edge.across(face);
      if (face < 0) {
        return;
      }
      const auto arrived =
          std::stable_partition(open_.begin(), open_.end(), [&](std::size_t k) { return !empty(face, k); });
      if (is_far_face(line_a, line, edge.line, exit.distance)) {
        auto& places = places_[{line_a, edge.line, side}];
        for (auto k = arrived; k != open_.end(); ++k) {
          places.emplace_back(column, static_cast<std::int32_t>(*k));
        }
      }
      open_.erase(arrived, open_.end());
    }
  }

  bool is_far_face(std::int32_t line_a, const Line2& a, std::int32_t line_b, double distance) const {
    return line_b > line_a && distance >= kThinnest_m &&
           angle_between(a.theta, complex_.lines[static_cast<std::size_t>(line_b)].line.theta) <=
               kParallel_rad;
  }

  const CellComplex& complex_;
  const std::vector<std::uint8_t>& label_;
  double max_m_, step_m_;
  Places places_;
  std::vector<std::size_t> start_, open_;  // layers
};

/// Marks what is missing between two columns of a layer that stand at most max_gap_m apart.
void mark_gaps(RoomWall& wall, double max_gap_m) {
  const auto most = static_cast<std::size_t>(std::floor(max_gap_m / wall.step_m));
  for (std::size_t k = 0; k < wall.layers; ++k) {
    std::size_t last = wall.columns;  // none yet
    for (std::size_t c = 0; c < wall.columns; ++c) {
      if (!wall.stands(c, k)) {
        continue;
      }
      if (last < c && c - last - 1 <= most) {
        for (std::size_t gap = last + 1; gap < c; ++gap) {
          wall.wall[gap * wall.layers + k] = 2;
        }
      }
      last = c;
    }
  }
}

}  // namespace

std::vector<RoomWall> find_room_walls(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                                      double max_thickness_m, double max_gap_m, double step_m) {
  std::vector<RoomWall> walls;
  for (const auto& [key, places] : Walker(complex, label, max_thickness_m, step_m).walk_all()) {
    if (places.empty()) {
      continue;
    }
    RoomWall wall;
    std::tie(wall.line_a, wall.line_b, wall.side) = key;
    wall.a = complex.lines[static_cast<std::size_t>(wall.line_a)].line;
    wall.b = complex.lines[static_cast<std::size_t>(wall.line_b)].line;
    wall.step_m = step_m;
    const auto [low, high] = std::minmax_element(places.begin(), places.end());
    wall.first = low->first;
    wall.columns = static_cast<std::size_t>(high->first - low->first + 1);
    wall.layers = complex.layers();
    wall.wall.assign(wall.columns * wall.layers, 0);
    for (const auto& [column, layer] : places) {
      wall.wall[static_cast<std::size_t>(column - wall.first) * wall.layers +
                static_cast<std::size_t>(layer)] = 1;
    }
    mark_gaps(wall, max_gap_m);
    walls.push_back(std::move(wall));
  }
  return walls;
}

}  // namespace roomcut::find_openings

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/one_sided.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>

#include "common/cells/plan_walk.h"

namespace roomcut::refine_lines {
namespace {

constexpr double kBeside = 0.04;    // [m] slivers between nearly equal lines are passed over
constexpr double kThinnest = 0.05;  // [m] of walls
constexpr double kThickest = 0.6;   // [m]
constexpr double kUsual = 0.15;     // [m] where the building tells nothing
constexpr double kParallel = 3 * std::numbers::pi / 180;
constexpr double kOverlap = 0.5;  // share of the wall along which another line closes it

/// Along which t the edge runs on its line.
std::pair<double, double> interval_of(const CellComplex& complex, std::size_t edge) {
  const CellComplex::Edge& e = complex.edges[edge];
  const Line2& line = complex.lines[static_cast<std::size_t>(e.line)].line;
  return std::minmax(line.along(complex.vertices[static_cast<std::size_t>(e.v0)]),
                     line.along(complex.vertices[static_cast<std::size_t>(e.v1)]));
}

/// Whether the normal of the edge's line points to the left of the edge.
bool left_is_plus(const CellComplex& complex, std::size_t edge) {
  const CellComplex::Edge& e = complex.edges[edge];
  const Vec2 along =
      complex.vertices[static_cast<std::size_t>(e.v1)] - complex.vertices[static_cast<std::size_t>(e.v0)];
  const Vec2 normal = complex.lines[static_cast<std::size_t>(e.line)].line.normal();
  return Vec2(-along.y(), along.x()).dot(normal) > 0;
}

/// Whether a line may carry a wall in all of these layers.
bool carries_in(const WallLine& line, const std::vector<std::int32_t>& layers) {
  return !line.levels || std::all_of(layers.begin(), layers.end(), [&](std::int32_t layer) {
    return std::find(line.levels->begin(), line.levels->end(), layer) != line.levels->end();
  });
}

/// The same wall as the refined line sees it, whose normal may point the other way: theta is in [0, pi).
OneSidedWall on_line(OneSidedWall wall, const Line2& line) {
  const auto [low, high] =
      std::minmax({line.along(wall.line.at(wall.t0)), line.along(wall.line.at(wall.t1))});
  wall.back_is_plus = wall.back_is_plus == (line.normal().dot(wall.line.normal()) > 0);
  wall.t0 = low;
  wall.t1 = high;
  wall.line = line;
  return wall;
}

bool closes(const WallLine& other, const OneSidedWall& wall) {
  const Line2& line = wall.line;
  const Line2 own = other.line();
  if (angle_between(own.theta, line.theta) > kParallel || !carries_in(other, wall.layers)) {
    return false;
  }
  const double distance = (wall.back_is_plus ? 1 : -1) * line.distance(other.centre());
  if (distance < kThinnest || distance > kThickest) {
    return false;
  }
  const auto [a, b] = std::minmax({line.along(other.a), line.along(other.b)});
  return std::min(b, wall.t1) - std::max(a, wall.t0) > kOverlap * (wall.t1 - wall.t0);
}

}  // namespace

std::vector<OneSidedWall> find_one_sided(const CellComplex& complex, const FaceWeights& weights,
                                         const std::vector<std::uint8_t>& label, double least_m2) {
  std::map<std::pair<std::int32_t, bool>, OneSidedWall> walls;
  for (std::size_t edge = 0; edge < complex.edges.size(); ++edge) {
    const std::int32_t line = complex.edges[edge].line;
    if (!complex.on_wall_line(complex.edges[edge])) {
      continue;
    }
    const std::int32_t left = walk_beside(complex, edge, true, kBeside);
    const std::int32_t right = walk_beside(complex, edge, false, kBeside);
    for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
      const std::size_t w = complex.wall_face(edge, layer);
      const float omega = weights.wall_omega[w];
      const FaceSide side = weights.wall_side(w);
      const bool front_left = side == FaceSide::kLeft;
      if (!weights.is_surely_wall(w) || side == FaceSide::kUnclear ||
          emptiness(complex, label, left, layer) == 0 || emptiness(complex, label, right, layer) == 0) {
        continue;
      }
      const bool back_is_plus = front_left != left_is_plus(complex, edge);
      const auto [t0, t1] = interval_of(complex, edge);
      OneSidedWall& wall = walls[{line, back_is_plus}];
      if (wall.layers.empty()) {
        wall = {complex.lines[static_cast<std::size_t>(line)].wall_id, back_is_plus, t0, t1, {}, 0,
                complex.lines[static_cast<std::size_t>(line)].line};
      }
      wall.t0 = std::min(wall.t0, t0);
      wall.t1 = std::max(wall.t1, t1);
      wall.layers.push_back(static_cast<std::int32_t>(layer));
      wall.area_m2 += static_cast<double>(omega) * complex.length(edge) * complex.height(layer);
    }
  }
  std::vector<OneSidedWall> found;
  for (auto& [key, wall] : walls) {
    if (wall.area_m2 >= least_m2) {
      std::sort(wall.layers.begin(), wall.layers.end());
      wall.layers.erase(std::unique(wall.layers.begin(), wall.layers.end()), wall.layers.end());
      found.push_back(std::move(wall));
    }
  }
  return found;
}

std::set<std::string> ids_of(const std::vector<OneSidedWall>& walls) {
  std::set<std::string> ids;
  for (const OneSidedWall& wall : walls) {
    ids.insert(wall.wall_id);
  }
  return ids;
}

double usual_thickness(const CellComplex& complex, const std::vector<std::uint8_t>& label) {
  std::vector<std::pair<double, double>> seen;  // thickness, area
  double total = 0;
  for (std::size_t edge = 0; edge < complex.edges.size(); ++edge) {
    for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
      const CellComplex::Edge& e = complex.edges[edge];
      const bool left = is_empty(complex, label, e.left, layer);
      if (!complex.on_wall_line(e) || left == is_empty(complex, label, e.right, layer)) {
        continue;
      }
      // Into the solid side, up to the first empty face of the plan.
      double thickness = 0;
      const Vec2 at = 0.5 * (complex.vertices[static_cast<std::size_t>(e.v0)] +
                             complex.vertices[static_cast<std::size_t>(e.v1)]);
      walk_beside(complex, edge, !left, kThickest, [&](std::size_t other, bool from_left) {
        const CellComplex::Edge& o = complex.edges[other];
        if (thickness == 0 && complex.on_wall_line(o) &&
            is_empty(complex, label, from_left ? o.right : o.left, layer)) {
          thickness = std::abs(complex.lines[static_cast<std::size_t>(o.line)].line.distance(at));
        }
      });
      if (thickness >= kThinnest) {
        const double area = complex.length(edge) * complex.height(layer);
        seen.emplace_back(thickness, area);
        total += area;
      }
    }
  }
  std::sort(seen.begin(), seen.end());
  double sum = 0;
  for (const auto& [thickness, area] : seen) {
    sum += area;
    if (2 * sum >= total) {
      return thickness;
    }
  }
  return kUsual;
}

int add_unseen_faces(const std::vector<OneSidedWall>& walls, double thickness_m, WallLines& lines) {
  std::vector<WallLine> added;
  for (const OneSidedWall& found : walls) {
    const auto seen = std::find_if(lines.lines.begin(), lines.lines.end(),
                                   [&](const WallLine& line) { return line.id == found.wall_id; });
    if (seen == lines.lines.end()) {
      continue;
    }
    const Line2 line = seen->line();
    const OneSidedWall wall = on_line(found, line);
    const bool closed = std::any_of(lines.lines.begin(), lines.lines.end(),
                                    [&](const WallLine& other) { return closes(other, wall); });
    if (closed) {
      continue;
    }
    const Vec2 behind = (wall.back_is_plus ? thickness_m : -thickness_m) * line.normal();
    WallLine unseen;
    unseen.id = wall.wall_id + (wall.back_is_plus ? ".unseen+" : ".unseen-");
    unseen.a = line.at(wall.t0) + behind;
    unseen.b = line.at(wall.t1) + behind;
    unseen.source = LineSource::kRefined;
    unseen.levels = std::vector<int>(wall.layers.begin(), wall.layers.end());
    char note[160];
    std::snprintf(note, sizeof note, "not seen: %.0f mm, the usual thickness of a wall, behind %s",
                  1e3 * thickness_m, wall.wall_id.c_str());
    unseen.note = note;
    added.push_back(std::move(unseen));
  }
  const int count = static_cast<int>(added.size());
  lines.lines.insert(lines.lines.end(), added.begin(), added.end());
  std::sort(lines.lines.begin(), lines.lines.end(),
            [](const WallLine& a, const WallLine& b) { return a.id < b.id; });
  return count;
}

}  // namespace roomcut::refine_lines

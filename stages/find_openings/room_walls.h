// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::find_openings {

/// A wall with a room on both sides, as the labelled complex has it: solid between two nearly parallel lines,
/// empty beyond both. Rastered along line a in columns of step_m.
struct RoomWall {
  std::int32_t line_a = -1, line_b = -1;  ///< indices into CellComplex::lines; line_a < line_b
  Line2 a, b;
  int side = 1;            ///< +1: b lies where a's normal points, -1: on the other side
  double step_m = 0;       ///< width of a column
  std::int64_t first = 0;  ///< column i is centred at (first + i + 1/2) · step_m along a
  std::size_t columns = 0, layers = 0;
  /// columns × layers: 1 where the wall stands, rooms on both sides; 2 in a gap between two such columns.
  std::vector<std::uint8_t> wall;

  /// Whether the wall stands there or on both sides of a gap.
  bool stands(std::size_t column, std::size_t layer) const { return wall[column * layers + layer] != 0; }
  bool is_gap(std::size_t column, std::size_t layer) const { return wall[column * layers + layer] == 2; }
  double t0() const { return static_cast<double>(first) * step_m; }
  double t1() const { return static_cast<double>(first + static_cast<std::int64_t>(columns)) * step_m; }
  /// Depth of p behind face a [m]: 0 on a, thickness(t) on b.
  double depth(const Vec2& p) const { return side * a.distance(p); }
  /// Distance from a to b across a, at coordinate t along a [m].
  double thickness(double t) const { return -b.distance(a.at(t)) / (side * b.normal().dot(a.normal())); }
};

/// All such walls up to max_thickness_m (at least 3 cm; the faces parallel within 3 degrees), by line_a,
/// line_b and side. Every column is found by walking from a through the solid cells, straight across the
/// wall, to the first empty one. Gaps up to max_gap_m between columns of a layer are marked: where lines of
/// another storey pass through a doorway, the cut may have emptied a part of it. Deterministic.
std::vector<RoomWall> find_room_walls(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                                      double max_thickness_m, double max_gap_m, double step_m);

}  // namespace roomcut::find_openings

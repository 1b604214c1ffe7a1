// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/detect_lines/circle_fit.h"
#include "stages/detect_lines/merge_lines.h"

namespace roomcut::detect_lines {

/// A curved wall: a part of a circle in plan, or all of it.
struct Arc {
  Vec2 centre{0, 0};
  double radius_m = 0;
  double from = 0, to = 0;  ///< azimuths from the centre, counter-clockwise, from < to <= from + 2 pi [rad]
  double seen = 0;          ///< share of its length that has cells
  CellIndices cells;        ///< of all slices
};

struct ArcRules {
  double tau_m = 0.04;
  double noise_m = 0.005;
  double max_gap_m = 1.2;  ///< doors and windows do not part an arc
};

/// The curved walls among the cells: chains of cells of which no straight line explains the direction, on a
/// circle of 0.3 ... 30 m radius over 20 degrees at least. A circle is taken where Schwarz's criterion
/// prefers it to the best polyline of the same cells: corners, oblique walls and true polygons stay what they
/// are. `lines` are those found without arcs: cells on a long one that does not bend begin none. `columns`
/// are cells that belong to columns. In the order of the cells; deterministic.
std::vector<Arc> find_arcs(const WallCells& cells, const std::vector<LineCandidate>& lines,
                           const CellIndices& columns, const ArcRules& rules);

/// The arc's chords, of equal angle and with a sagitta of max(noise, 5 mm) at most, so far out that the
/// polygon has the area of the sector; each with its cells.
std::vector<LineCandidate> chords_of(const WallCells& cells, const Arc& arc, double noise_m);

}  // namespace roomcut::detect_lines

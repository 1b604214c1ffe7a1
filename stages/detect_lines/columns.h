// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/detect_lines/outline_fit.h"

namespace roomcut::detect_lines {

/// A column or pier: a closed outline that stands free and goes up to the ceiling.
struct Column {
  Outline outline;
  double seen = 0;    ///< share of the outline that has cells
  CellIndices cells;  ///< of all slices in which it was seen
};

struct ColumnRules {
  double noise_m = 0.005;
  std::vector<double> heights;  ///< of the slices [m]
  OutlineRules fit;
};

/// The columns among all cells: groups of cells with nothing beside them, on a rectangle or a circle of 0.15
/// ... 2 m, seen from three sides at least, up to the ceiling, over 1.5 m of height, and free all around: a
/// closed outline with a wall behind its walls is a small room. Columns that agree in size have it in common,
/// and then one that was seen less well is still one of them. In the order of slices and cells;
/// deterministic.
std::vector<Column> find_columns(const WallCells& cells, const ColumnRules& rules);

/// The direction that most of the walls have, modulo 90 degrees [rad].
double main_direction(const WallCells& cells);

}  // namespace roomcut::detect_lines

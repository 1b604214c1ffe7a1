// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/detect_lines/columns.h"
#include "stages/detect_lines/merge_lines.h"

namespace roomcut::detect_lines {

struct ColumnLineRules {
  double theta = 0;          ///< direction of the walls, modulo 90 degrees [rad]
  double aligned_m = 0.004;  ///< sides in a row that differ by less are one line
  OutlineRules fit;
};

/// The sides of the columns as lines: four each, of a round one the chords of a regular polygon of its area,
/// which looks towards `theta`. A rectangle that stands as the walls do within its uncertainty is turned to
/// them. Sides of several columns in one row are one line: beside lines a millimetre apart stand slivers that
/// no later stage can tell from walls.
std::vector<LineCandidate> lines_of_columns(const WallCells& cells, std::vector<Column> columns,
                                            const ColumnLineRules& rules);

}  // namespace roomcut::detect_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/detect_lines/aligned_sides.h"
#include "stages/detect_lines/columns.h"

namespace roomcut::detect_lines {

/// The sides of the columns: four each, of a round one the chords of a regular polygon of its area, which
/// looks towards `theta`. A rectangle that stands within its uncertainty as the walls do, in direction
/// `theta` modulo 90 degrees, is turned to them.
std::vector<Side> sides_of_columns(const WallCells& cells, std::vector<Column> columns, double theta,
                                   const OutlineRules& fit);

}  // namespace roomcut::detect_lines

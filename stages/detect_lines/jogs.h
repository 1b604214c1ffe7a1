// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/detect_lines/aligned_sides.h"
#include "stages/detect_lines/short_pieces.h"

namespace roomcut::detect_lines {

/// The short faces of niches, pilasters and jumps of a wall that the search for lines leaves out. Where one
/// stretch of wall ends and a parallel one 5 ... 60 cm beside it begins, there is a reveal between them, at
/// the cells between, else half way between both ends. A short piece counts only when both of its ends are
/// closed like that, or by a line across, and when it goes up to the ceiling (Upward): furniture and clutter
/// beside a wall do not. `free` are the cells that no line
/// has.
std::vector<Side> short_sides(const WallCells& cells, const CellIndices& free,
                              const std::vector<LineCandidate>& lines, const PieceRules& rules);

}  // namespace roomcut::detect_lines

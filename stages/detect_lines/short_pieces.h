// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/detect_lines/merge_lines.h"

namespace roomcut::detect_lines {

struct PieceRules {
  double tau_m = 0.04;
  double noise_m = 0.005;
  double inlier_m = 0.025;  ///< cells so near a line are explained by it
};

/// A stretch of wall without a gap, seen in one slice.
struct WallPiece {
  Line2 line;
  double t0 = 0, t1 = 0;  ///< along `line`: outermost cells [m]
  std::int32_t slice = 0;
  CellIndices cells;
  int of = -1;  ///< index of the line it is a part of; -1 = of none
};

/// The stretches of the lines that their cells cover, slice by slice, and those of the `free` cells, which no
/// line has, that lie on them: near corners a cell has no direction.
std::vector<WallPiece> pieces_of_lines(const WallCells& cells, const CellIndices& free,
                                       const std::vector<LineCandidate>& lines, const PieceRules& rules);

/// Straight rows of at least 18 cm among the cells that no line explains and that lie beside a line, parallel
/// or across to it: backs of niches, fronts of pilasters, pieces of a wall that jumps. `free` are the cells
/// that no line has. A row on one of the lines is a piece of that line.
std::vector<WallPiece> short_pieces(const WallCells& cells, const CellIndices& free,
                                    const std::vector<LineCandidate>& lines, const PieceRules& rules);

}  // namespace roomcut::detect_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/detect_lines/outline_fit.h"

namespace roomcut::detect_lines {

/// Which places along an outline have cells.
struct OutlineSight {
  double share = 0;  ///< of the whole outline
  double gap = 0;    ///< longest piece without cells, as a share of the outline
  int sides = 0;     ///< of a rectangle: those of which 40 % was seen
};

/// The places of `outline` that have cells of `group` within `near_m`, in pieces of `piece_m`.
OutlineSight sight_of(const WallCells& cells, const CellIndices& group, const Outline& outline,
                      double piece_m, double near_m);

/// The share of `outline` beside which, from `near_m` to `far_m` outside, there is none of `around`.
double free_share(const WallCells& cells, const CellIndices& around, const Outline& outline, double near_m,
                  double far_m);

}  // namespace roomcut::detect_lines

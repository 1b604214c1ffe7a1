// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "common/cells/cell_complex.h"

namespace roomcut {

/// Shares of a wall face's length along which floor and ceiling reach it from its left and its right, 0 … 1.
struct StripShares {
  double left = 0, right = 0;
};

/// Probability that the empty side of a wall face is its left one. A wall stands where a floor and a ceiling
/// end: asked are the faces of the plan on both sides, `beside_m` beside the wall (slivers between nearly
/// equal lines have no floor of their own), at the nearest levels below and above and, as far as these say
/// nothing and the wall goes on, at the next ones; and the strips right beside it. Needs wall_omega,
/// level_floor and level_ceiling. No evidence: 1/2.
double left_probability(const CellComplex& complex, const FaceWeights& weights, std::size_t edge,
                        std::size_t layer, const StripShares& strips, double beside_m);

}  // namespace roomcut

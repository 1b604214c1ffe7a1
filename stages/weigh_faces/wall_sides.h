// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "common/cells/cell_complex.h"

namespace roomcut {

/// Columns of a wall face along which floor or ceiling reaches the wall from its left and its right.
struct StripCounts {
  double left = 0, right = 0;
};

/// Probability that the empty side of a wall face is its left one. A wall stands where a floor and a ceiling
/// end: asked are the faces of the plan on both sides, at the nearest floor below and the nearest ceiling
/// above as far as the wall goes on, `beside_m` beside the wall (slivers between nearly equal
/// lines have no floor of their own), and the strips right beside it. Needs
/// wall_omega, level_floor and level_ceiling. No evidence: 1/2.
double left_probability(const CellComplex& complex, const FaceWeights& weights, std::size_t edge,
                        std::size_t layer, const StripCounts& strips, double beside_m);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "common/cells/cell_complex.h"

namespace roomcut {

/// Columns of a wall face along which floor or ceiling reaches the wall from its left and its right.
struct StripCounts {
  double left = 0, right = 0;
};

/// The face of the plan at `distance_m` straight beside the middle of an edge, on its left or right; -1 =
/// beyond the bounding box. Slivers between nearly equal lines are passed over: they have no floor of their
/// own.
std::int32_t face_beside(const CellComplex& complex, std::size_t edge, bool left, double distance_m);

/// Probability that the empty side of a wall face is its left one. A wall stands where a floor and a ceiling
/// end: asked are the faces of the plan on both sides, at the nearest floor below and the nearest ceiling
/// above as far as the wall goes on, `beside_m` beside the wall, and the strips right beside it. Needs
/// wall_omega, level_floor and level_ceiling. No evidence: 1/2.
double left_probability(const CellComplex& complex, const FaceWeights& weights, std::size_t edge,
                        std::size_t layer, const StripCounts& strips, double beside_m);

}  // namespace roomcut

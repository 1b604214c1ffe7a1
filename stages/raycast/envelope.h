// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::raycast {

/// How far the middle of every plan face lies beyond the building's envelope [m]; 0 = within. The envelope is
/// the smallest convex polygon around the plan faces of `indoors` (one flag per cell) whose sides run along
/// directions of walls. A room that nobody entered fills a gap between other rooms or a corner of the
/// building; balconies, gardens and neighbours' facades lie beyond. Directions are those that share at least
/// a twelfth of the covered wall area, so that turning the plan turns the envelope. 0 everywhere when no cell
/// is indoors or no wall was seen. Deterministic.
std::vector<double> beyond_envelope(const CellComplex& complex, const FaceWeights& weights,
                                    const std::vector<std::uint8_t>& indoors);

/// The directions of walls that beyond_envelope() takes, as unit vectors, the most covered first.
std::vector<Vec2> wall_directions(const CellComplex& complex, const FaceWeights& weights);

}  // namespace roomcut::raycast

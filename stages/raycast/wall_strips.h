// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/raycast/cell_evidence.h"

namespace roomcut::raycast {

/// Per cell, how surely it is a piece of a wall of which nobody saw this piece, 0 … 1: walls go on, along the
/// plan and from storey to storey. A *strip* is what lies between two lines as close together and as parallel
/// as the faces of a wall. Of a strip's cells some show both lines their backs, so it is a wall there; some
/// show floor and ceiling, so it is open there, as in a doorway. The share of the wall in what was seen of
/// the strip, times how little of the cell itself was seen. `evidence`: one per cell. Deterministic.
std::vector<double> walls_that_go_on(const CellComplex& complex, const FaceWeights& weights,
                                     const std::vector<CellEvidence>& evidence);

}  // namespace roomcut::raycast

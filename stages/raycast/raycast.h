// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/cell_complex.h"
#include "stages/raycast/cell_evidence.h"
#include "stages/raycast/params.h"

namespace roomcut::raycast {

/// Log-odds of a cell being empty: the weighted sum of all measures (README.md, Weights).
double empty_log_odds(const CellEvidence& evidence);

/// Data term of every cell (paper §2), in parallel; the same for any number of threads. `weights` must belong
/// to `complex`.
DataTerms cast_rays(const CellComplex& complex, const FaceWeights& weights, const RaycastParams& params);

}  // namespace roomcut::raycast

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/cell_complex.h"
#include "stages/raycast/params.h"

namespace roomcut::raycast {

/// Data term of every cell (paper §2), in parallel; the same for any number of threads. `weights` must belong
/// to `complex`. Features are weighed as shipped_weights() says.
DataTerms cast_rays(const CellComplex& complex, const FaceWeights& weights, const RaycastParams& params);

}  // namespace roomcut::raycast

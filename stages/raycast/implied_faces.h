// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/raycast/face_walk.h"

namespace roomcut::raycast {

/// For each face, how certain it is to be the unseen side of a wall or slab, 0 … 1. What shows its back has a
/// thickness: a surface must follow behind it, though no point lies there (an opposite room that was not
/// entered, furniture along the wall). graphcut charges a face 1 - implied of what it costs to be unseen.
struct ImpliedFaces {
  std::vector<float> wall, level;  ///< per wall face and level face of the complex
};

/// Weight of a back at this distance straight behind a face [m]: full up to the thickness of common walls and
/// slabs, zero beyond that of thick ones.
double thickness_weight(double distance_m);

/// Looks from points of every face straight to both sides. In parallel; the same for any number of threads.
ImpliedFaces find_implied_faces(const CellComplex& complex, const FaceWalk& walk);

}  // namespace roomcut::raycast

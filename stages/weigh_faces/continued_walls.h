// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/cell_complex.h"

namespace roomcut::weigh_faces {

/// Walls are upright: a wall face too small to have been hit by more than a few points is covered as the one
/// above or below it in the same wall is, with the weight of three points against the number expected on its
/// own area (at the neighbour's density). So a step of the floor 15 cm high opens no hole in a wall that a
/// sparse scan happened to miss there. Not across a floor or a ceiling that was seen on the wall's empty
/// side: there the room ends. Needs all of the wall faces' and the levels' weights. Deterministic.
void continue_walls(const CellComplex& complex, FaceWeights& weights);

}  // namespace roomcut::weigh_faces

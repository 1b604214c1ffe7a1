// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/raycast/face_walk.h"

namespace roomcut::raycast {

/// The share of each cell that the scanners looked through, 0 … 1: 1 - prod over stations (1 - V_s / V),
/// where V_s is the volume between the station and the surfaces that it saw. `stations` are scanner
/// positions, local metres; those outside the bounding box are passed over. From each, rays go out evenly in
/// all directions; a ray passes what was not covered and ends on a front (as far as that was seen: unlike for
/// other rays nothing is completed). What leaves the building, through windows, carves nothing. No pass over
/// the points. Stations run in parallel and are multiplied in their order: the same for any number of
/// threads.
std::vector<double> carve_lines_of_sight(const CellComplex& complex, const FaceWalk& walk,
                                         const std::vector<Vec3>& stations);

}  // namespace roomcut::raycast

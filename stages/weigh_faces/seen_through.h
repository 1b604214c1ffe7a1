// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/cell_complex.h"

namespace roomcut::weigh_faces {

/// Takes back the coverage of walls that were seen through the openings of another wall. A surface close
/// behind another one that looks the same way, on which the points lie an order of magnitude sparser, is the
/// outer frame of windows or the far side of niches: its few points are all that could be seen, while the
/// correction for the density took them for a thin sample of a whole wall. Scales wall_omega, wall_left and
/// wall_right. Needs all of them; deterministic.
void discount_seen_through(const CellComplex& complex, FaceWeights& weights);

}  // namespace roomcut::weigh_faces

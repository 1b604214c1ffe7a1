// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/sloped_plane.h"
#include "common/slices/slices.h"
#include "stages/slice/surfaces.h"
#include "stages/slice/survey.h"

namespace roomcut::slice {

/// Adds the levels that stand for slopes, as stairs would. Deterministic.
///
/// Planes: between two neighbouring levels that planes pass by more than 8 cm, what they cover is cut into
/// equal steps of about `step_m` with a level at the middle of each; a plane that meets none of these gets
/// one at the middle of its own heights there. None lies nearer than 10 cm to another level.
///
/// Slopes that no plane explains: levels about `step_m` apart where at least 15 m^2, and a fifth of the
/// upright surface over the building that has no level above it, are sloped, and twice as much as lies level
/// there. The slope's bulk, without 1 % at both ends, is cut into equal steps, none nearer than half a step
/// to another level.
void add_steps(std::vector<Level>& levels, const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
               const std::vector<SlopedPlane>& planes, double step_m);

}  // namespace roomcut::slice

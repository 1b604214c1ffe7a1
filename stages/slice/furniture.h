// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/slice/surface_graph.h"
#include "stages/slice/survey.h"

namespace roomcut::slice {

/// Whether a surface 0.25 … 1.3 m above a floor is a table, a bed or a counter rather than a floor of its
/// own: the lower level's floor is seen under a quarter of it; or that floor goes on beside 40 % of its
/// border, and it is narrower than 1.6 m (twice area by border), or smaller than 12 m^2 and no room: walls
/// rise beside less than four fifths of its border. `all` finds the cells of the whole building, of raster
/// `survey.raster_m`. Deterministic.
bool is_furniture(const SurfaceComponent& surface, const Level& floor, const CellIndex& all,
                  const HeightSurvey& survey);

}  // namespace roomcut::slice

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/tools/synthesize/building.h"

namespace roomcut::synthesize {

/// Fills building.stations: those of the scene, or enough per scanned room that no spot of its floor is
/// further than 6 m from one, clear of walls and furniture.
void place_stations(const Scene& scene, Building& building);

}  // namespace roomcut::synthesize

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// What a random building may have beside level rooms between straight walls.
const std::vector<std::string>& element_names();

/// Adds elements to the rooms of `scene`, a random building, and fits its doors, windows and shafts to them:
/// - "arcs": bays, rounded corners, round towers (arc_elements.h);
/// - "roof": one roof (monopitch, gable or hip) over the top storey, with or without a knee wall or collar;
/// - "ramps": sloped floors, and ramps up to a platform, in some rooms;
/// - "heights": every room's floor and ceiling are off the storey's by 0, 1, 2 or 3 cm;
/// - "beams": up to three across a room, 15 to 40 cm below its ceiling;
/// - "columns": rows of columns in large rooms;
/// - "niches": recesses in outer walls, pilasters before any.
/// Each is a pure function of the building and the seed, drawn from numbers of its own.
void add_elements(const std::vector<std::string>& elements, std::uint64_t seed, Scene& scene);

}  // namespace roomcut::synthesize

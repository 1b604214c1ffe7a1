// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// Makes walls of a random building round, clear of its doors, windows and shafts: bays that bulge outwards
/// or into the room behind, corners rounded off, round towers before the facade with a door. `draw` gives
/// random numbers in [0, 1).
void add_arcs(Scene& scene, const std::function<double()>& draw);

}  // namespace roomcut::synthesize

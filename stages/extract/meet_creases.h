// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/cell_complex.h"
#include "common/cells/level_surfaces.h"

namespace roomcut::extract {

/// Moves the plan's creases to where their two planes now meet. The lines were drawn where a sloped plane
/// meets a level or another plane as they were found; fitted anew they meet some millimetres beside, and
/// would be left with an upright strip between them. A vertex stays on the walls that pass through it, moves
/// by at most 0.15 m, and not so far that a face beside it would turn over: then the strip stays. Nothing
/// else of the complex changes. Returns how many vertices moved.
int meet_creases(const std::vector<std::uint8_t>& label, const LevelSurfaces& surfaces, CellComplex& complex);

}  // namespace roomcut::extract

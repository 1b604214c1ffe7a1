// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/level_surfaces.h"
#include "stages/extract/cut_openings.h"

namespace roomcut::extract {

/// Levels of steps stand for sloped planes alone: a floor or ceiling there that has no surface (a sliver
/// between creases that do not quite meet, without points) gets that of the sloped one beside it along its
/// longest side, if that passes within a step of the level.
void follow_planes(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                   LevelSurfaces& surfaces);

/// The surfaces of a complex for the one that openings were cut into: a part of a level face has its surface.
/// Levels that openings brought have none, and heads stay level. The floor of an opening that had none
/// follows the floor of the room beside it, the first one's if it has a surface, where it begins on its
/// level: no threshold.
LevelSurfaces carry_surfaces(const CellComplex& complex, const LevelSurfaces& surfaces,
                             const OpenableComplex& cut);

}  // namespace roomcut::extract

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut {

/// Restricts detected lines to the layers in which the first cut has something on them: surface between an
/// empty and a solid cell, or a wall face of which a tenth was seen. A wall's line runs through all storeys;
/// where another one stands a few centimetres beside, it would cut a sliver off that wall in the second pass,
/// and points beside the two would belong to neither. Lines of the user's keep their `levels`, and so do
/// lines that carry nothing anywhere. `label` as in Labels.
void restrict_to_carried_layers(const CellComplex& complex, const FaceWeights& weights,
                                const std::vector<std::uint8_t>& label, WallLines& lines);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/face_locator.h"
#include "stages/tools/evaluate/explain.h"

namespace roomcut::evaluate {

/// What labels and evidence say of a set of cells, each named once.
Explanation::Evidence evidence_of(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                                  const DataTerms* terms, const std::vector<std::size_t>& cells);

/// The walls and slabs whose loss merges two found rooms: where, in which cells, between which lines.
/// `truth_label`: the truth's label per cell.
std::vector<Explanation::LostWall> find_lost_walls(const ExplainInput& input, const FaceLocator& locator,
                                                   const std::vector<std::uint8_t>& truth_label);

}  // namespace roomcut::evaluate

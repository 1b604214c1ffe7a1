// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/detect_lines/line_fit.h"

namespace roomcut::detect_lines {

/// Parts `some` cells into groups that lie together: cells of one slice, in a grid of edge `tau_m`, at most
/// `reach` columns and rows apart from the next one of their group. In the order of their first cells.
std::vector<CellIndices> group_cells(const WallCells& cells, const CellIndices& some, double tau_m,
                                     std::int32_t reach);

}  // namespace roomcut::detect_lines

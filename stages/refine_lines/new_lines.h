// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/refine_lines/line_item.h"
#include "stages/refine_lines/one_sided.h"

namespace roomcut::refine_lines {

// Lines that refinement adds: all give them the id of the line that they come from and a number ("w0007.1"),
// and return how many there are.

/// Splits lines whose walls lie in planes more than `apart_m` [m] apart (split_line()). Hand-edited lines
/// stay whole: the user decided what is one wall. A wall seen from one side goes to the nearest part.
int split_items(const CellComplex& complex, double apart_m,
                const std::function<LinePrior(const LineItem&)>& prior_of,
                std::vector<OneSidedWall>& one_sided, std::vector<LineItem>& items);

/// Splits lines along which a wall bends (find_hinge()), except hand-edited lines and those of walls seen
/// from one side.
int split_at_hinges(const CellComplex& complex, std::vector<LineItem>& items);

/// Adds the walls that bend off the fitted lines (find_bends()).
int add_bends(const CellComplex& complex, std::vector<LineItem>& items);

}  // namespace roomcut::refine_lines

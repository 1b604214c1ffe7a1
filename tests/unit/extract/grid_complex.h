// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::test {

/// A complex over a grid of plan lines x_i and y_j, turned by `angle` about the origin; the outermost lines
/// are the bounding box. `joined(i, j)` says whether the grid cells (i, j) and (i + 1, j) are one face (never
/// two such in a row): its neighbours above and below then see a vertex in the middle of a straight side.
CellComplex grid_complex(const std::vector<double>& x, const std::vector<double>& y,
                         const std::vector<double>& levels, double angle = 0,
                         const std::function<bool(int, int)>& joined = {});

/// Labels of a complex: a cell is empty when `empty(centroid of its plan, middle of its layer)`.
Labels label_where(const CellComplex& complex, const std::function<bool(const Vec2&, double)>& empty);

}  // namespace roomcut::test

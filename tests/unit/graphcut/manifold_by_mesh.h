// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::graphcut {

/// The oracle of the manifold tests: builds the surface as a polygon mesh and applies the textbook rule to
/// it. Returns the (level, vertex) pairs where the faces of the surface are not one single fan or where an
/// edge of the surface that ends there has not exactly two faces.
std::set<std::pair<int, int>> non_manifold_vertices(const CellComplex& complex,
                                                    const std::vector<std::uint8_t>& label);

}  // namespace roomcut::graphcut

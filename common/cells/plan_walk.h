// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "common/cells/cell_complex.h"

namespace roomcut {

/// Walks through the plan from the middle of an edge straight to its left or right, up to `distance_m`, and
/// calls `crossed(edge, from_left)` for every edge on the way, nearest first; `from_left` = the way comes
/// from that edge's left side. Returns the face of the plan where it ends; -1 = beyond the bounding box. No
/// search structure: a convex face is left by the one side whose ends lie on both sides of the way.
std::int32_t walk_beside(const CellComplex& complex, std::size_t edge, bool left, double distance_m,
                         const std::function<void(std::size_t, bool)>& crossed = {});

}  // namespace roomcut

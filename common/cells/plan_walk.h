// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "common/cells/cell_complex.h"

namespace roomcut {

/// Where a straight way leaves a face of the plan.
struct FaceExit {
  std::int32_t edge = -1;                                     ///< -1: nowhere, the way is no way
  double distance = std::numeric_limits<double>::infinity();  ///< from the start of the way [m]
};

/// Where the way from `start`, in the face, along the unit vector `to` leaves it: by the side whose ends lie
/// right and left of it. Of sides on one line the distances are equal; their ends tell them apart.
FaceExit leave_face(const CellComplex& complex, std::size_t face, const Vec2& start, const Vec2& to);

/// Walks through the plan from the middle of an edge straight to its left or right, up to `distance_m`, and
/// calls `crossed(edge, from_left)` for every edge on the way, nearest first; `from_left` = the way comes
/// from that edge's left side. Returns the face of the plan where it ends; -1 = beyond the bounding box. No
/// search structure: a convex face is left by the one side whose ends lie on both sides of the way.
std::int32_t walk_beside(const CellComplex& complex, std::size_t edge, bool left, double distance_m,
                         const std::function<void(std::size_t, bool)>& crossed = {});

}  // namespace roomcut

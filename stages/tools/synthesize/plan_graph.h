// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// Segments that meet in common corners only.
struct PlanGraph {
  std::vector<Vec2> vertices;                         ///< [m], further apart than the tolerance
  std::vector<std::array<std::int32_t, 2>> segments;  ///< each once, smaller index first, sorted
};

/// Cuts the polygons' sides where they cross, touch or run over each other. Corners within `tolerance` of
/// each other become one, and a side is led through every corner within the tolerance of it: what moves,
/// moves by the distance it was off, which for plans that mean the same wall is the rounding of their
/// numbers. After that, nothing is closer than the tolerance without being joined, so that rounding new
/// corners to double cannot make segments cross.
PlanGraph cut_at_crossings(const std::vector<Polygon2>& polygons, double tolerance);

}  // namespace roomcut::synthesize

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut::test {

using Ends = std::array<Vec2, 2>;

/// What a subdivision of a rectangle consists of.
struct PlanCounts {
  std::size_t vertices = 0, edges = 0, faces = 0;
  std::vector<double> areas;  ///< of the faces, ascending [m^2]
  /// The least that anything is off from touching: a vertex from another one or from an edge, the end of a
  /// segment from a line across it [m]. What is off by less than 1e-9 m counts as touching.
  double margin = 1e9;
};

/// The rectangle from (0, 0) to `high`, cut by the segments one after the other, each lengthened at both ends
/// to the next edge there: an arrangement of CGAL, in exact numbers.
PlanCounts exact_plan(const Vec2& high, const std::vector<Ends>& segments);

}  // namespace roomcut::test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "stages/extract/columns.h"

namespace roomcut::extract {

/// The corners of all runs, joined where they meet. Places are the plan's vertices and, after them, the
/// points where floors and ceilings of the one or the two faces beside an edge cross over it: between two
/// places that follow each other along an edge no two of its floors and ceilings cross. Knots are the corners
/// of the model: heights at a place that lie closer than weld_distance() are one.
struct WeldedColumns {
  std::vector<Vec2> places;
  std::vector<Vec3> knots;  ///< by place, ascending: of one place, more is higher

  std::vector<std::int64_t>
      crossing_offset;  ///< edges + 1: places crossing_offset[e] … along edge e, from v0
  std::vector<std::int64_t> corner_offset;  ///< faces + 1, into corner_place
  std::vector<std::int32_t> corner_place;   ///< of every face, counter-clockwise
  std::vector<std::int32_t> corner_edge;    ///< parallel: the edge from this corner to the next
  std::vector<std::int64_t> knot_offset;    ///< runs + 1, into lower and upper
  std::vector<std::int32_t> lower, upper;   ///< knots of every run at its face's corners

  std::size_t corners(std::size_t face) const {
    return static_cast<std::size_t>(corner_offset[face + 1] - corner_offset[face]);
  }
};

WeldedColumns weld_columns(const EndHeights& heights, const Columns& columns);

}  // namespace roomcut::extract

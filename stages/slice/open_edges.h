// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry/line2.h"
#include "common/slices/slices.h"
#include "stages/slice/surfaces.h"
#include "stages/slice/survey.h"

namespace roomcut::slice {

/// A straight stretch along which a ceiling ends while the floor goes on below the open sky: the glass of a
/// facade, an open side. No upright surface says so.
struct OpenEdge {
  Vec2 a{0, 0}, b{0, 0};  ///< its ends [m]
  std::size_t level = 0;  ///< index of the ceiling
  double length_m() const { return (b - a).norm(); }
};

/// The open edges of all levels that are peaks, at least 3.5 m long, longest first for each level. On both
/// sides a floor is seen more than 1.5 m below; beyond the edge nothing lies as high as the ceiling or
/// higher, and little upright surface stands under it. Their place is where the ceiling's area ends, to half
/// of the raster. Deterministic.
std::vector<OpenEdge> open_edges(const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
                                 const std::vector<Level>& levels);

/// Occupies the cells of the wall slice below the ceiling along the edge, as a wall there would.
void add_open_edge(const OpenEdge& edge, double tau_m, OccupancyGrid& grid);

}  // namespace roomcut::slice

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/cells/cell_complex.h"
#include "common/openings/opening.h"
#include "stages/find_openings/params.h"
#include "stages/find_openings/reveal.h"
#include "stages/find_openings/room_walls.h"
#include "stages/find_openings/wall_evidence.h"

namespace roomcut::find_openings {

OpeningTolerances opening_tolerances(const FindOpeningsParams& params, double noise_m, double density);

inline constexpr double kColumn_m = 0.05;  ///< of the walls' rasters
inline constexpr double kWidestGap_m = 3;  ///< of a wall's columns: what the cut emptied of a doorway

/// The openings of one wall. A place is an opening when *all* of this holds:
///  - two jambs, min_width_m … max_width_m apart: upright surfaces between the wall's faces, with points on
///    45 % of the height up to min_height_m;
///  - a head between them, at least min_height_m above the floor, with points on half of the width;
///  - both faces are uncovered from jamb to jamb (a fifth at most is covered) and no points are between them
///    (an eighth at most), also beside each jamb and below the head by themselves: a closed door, a niche or
///    a bookcase in the wall is no opening;
///  - beside both jambs, and above the head, one of the two faces is covered: there the wall goes on;
///  - the wall stands, with rooms on both sides, from the floor to beyond the head and beyond the jambs;
///    where the cut has left a gap in it, a lintel with points has to prove it.
/// Partial evidence makes no opening. `levels` as in CellComplex. Ids and walls are left empty.
std::vector<Opening> find_openings_in(const RoomWall& wall, const WallRasters& rasters,
                                      const std::vector<double>& levels, const FindOpeningsParams& params,
                                      const OpeningTolerances& tolerances);

/// Heads that differ by no more than the noise explains (4 mm or 3 standard deviations) get one height, their
/// mean: the doors of a storey mostly have one, and each further height is a level of the model. Heads at a
/// level (openings up to the ceiling) stay.
void join_heads(std::vector<Opening>& openings, const std::vector<double>& levels);

/// Openings of all walls, sorted by place, with ids o0001 … and the ids of their walls; heads joined.
std::vector<Opening> find_openings(const CellComplex& complex, const std::vector<RoomWall>& walls,
                                   const WallEvidence& evidence, const FindOpeningsParams& params,
                                   const OpeningTolerances& tolerances);

}  // namespace roomcut::find_openings

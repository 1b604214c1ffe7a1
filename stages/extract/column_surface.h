// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/mesh/facet_surface.h"
#include "stages/extract/welded_columns.h"

namespace roomcut::extract {

/// The border of all runs as facets whose normals point out of the empty space, and what they enclose.
struct ColumnSurface {
  FacetSurface facets;  ///< over the knots
  double volume_m3 = 0;
};

/// Floors and ceilings: of every run the part of its plan face where the one lies over the other; a run that
/// has none is not there. Walls: along every edge where the run of one side is beside none of the other's.
/// All facets have all knots on their borders as corners, so they share whole edges. Planes: a wall line (or
/// side of the bounding box) and a side of it; a surface or a level, up or down. Facets carry the storey of
/// their run.
ColumnSurface surface_of_columns(const EndHeights& heights, const Columns& columns,
                                 const WeldedColumns& welded);

/// The surface whose floors or ceilings carry this name of a plane; -1 = a level or a wall.
std::int32_t surface_of_plane(const CellComplex& complex, std::int64_t plane);

}  // namespace roomcut::extract

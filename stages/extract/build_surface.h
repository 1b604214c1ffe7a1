// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/cells/level_surfaces.h"
#include "common/mesh/facet_surface.h"
#include "common/mesh/mesh_check.h"
#include "stages/extract/storeys.h"

namespace roomcut::extract {

/// Areas of the model's surface by kind [m^2].
struct SurfaceAreas {
  double floor = 0, ceiling = 0, wall = 0;
};

/// The surface of a labelling, checked.
struct BuiltSurface {
  MergedSurface merged;
  SurfaceAreas areas;
  double empty_m3 = 0;  ///< between the floors and the ceilings of all runs
  MeshCheck check;
  std::string fault;                  ///< "" or why the mesh must not be used
  std::vector<std::size_t> put_back;  ///< level faces that went back from their surfaces to their levels
};

/// Builds the border of the empty cells with its floors and ceilings at `surfaces`, and checks it. Where
/// surfaces would not leave a sound model, level faces go back to their levels, in `surfaces`, too: those of
/// slabs without thickness; at the places where the model would touch itself one after the other, the one that
/// moves least first; and if that does not mend it, all.
BuiltSurface build_surface(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                           const Storeys& storeys, LevelSurfaces& surfaces);

}  // namespace roomcut::extract

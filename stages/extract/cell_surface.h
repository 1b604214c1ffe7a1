// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/cell_complex.h"
#include "common/mesh/facet_surface.h"
#include "stages/extract/storeys.h"

namespace roomcut::extract {

/// The faces of the product complex where the label differs (beyond the bounding box all is solid), as facets
/// whose normals point out of the empty cell. Vertex (v, level l) has index l * vertices + v and the
/// complex's coordinates. Planes: a wall line (or side of the bounding box) and a side of it; a level, up or
/// down. Facets carry the storey of their empty cell.
FacetSurface surface_of_labels(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                               const Storeys& storeys);

/// Sum of the volumes of the empty cells [m^3].
double empty_volume(const CellComplex& complex, const std::vector<std::uint8_t>& label);

}  // namespace roomcut::extract

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/plan/subdivision.h"

namespace roomcut {

/// The plan of a complex, to be cut further: face f of the complex is the original face f.
Subdivision plan_of(const CellComplex& complex);

/// Sets vertices, faces and edges of the complex to those of the subdivision: face i is faces[i], `faces` all
/// that are left. Vertices and edges are numbered as the faces come upon them, so that neighbours in space
/// have neighbouring numbers when `faces` are in such an order (the later stages walk over them). Edges run
/// with their first face on the left.
void set_plan(const Subdivision& plan, const std::vector<std::int32_t>& faces, CellComplex& complex);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/cell_complex.h"
#include "stages/partition/subdivision.h"

namespace roomcut::partition {

/// Fills vertices, faces and edges of the complex from the subdivision, numbered so that neighbours in space
/// have neighbouring numbers (the later stages walk over them). Edges run with their first face on the left.
void to_complex(const Subdivision& plan, CellComplex& complex);

}  // namespace roomcut::partition

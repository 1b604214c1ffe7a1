// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "common/cells/cell_complex.h"
#include "stages/graphcut/params.h"

namespace roomcut::graphcut {

struct Graphcut {
  Labels labels;
  double cut_m3 = 0;            ///< least energy of all labellings, the flow
  double repair_m3 = 0;         ///< what the repair added to it
  std::int64_t bad_places = 0;  ///< vertices of the complex where the cut was not manifold
  std::int64_t empty_cells = 0;
  double empty_m3 = 0;             ///< volume of the empty cells
  double unobserved_empty_m3 = 0;  ///< the part of it that is unobserved
};

/// Labelling of paper §2: one exact max-flow over all cells, then the repair of the labels to a 2-manifold
/// surface. A cell is `unobserved` when fewer than min_observed of its rays end on a seen face.
/// Deterministic. Throws StageError(kEmptyModel) with the evidence when every cell comes out solid.
Graphcut graphcut(const CellComplex& complex, const FaceWeights& weights, const DataTerms& terms,
                  const GraphcutParams& params);

}  // namespace roomcut::graphcut

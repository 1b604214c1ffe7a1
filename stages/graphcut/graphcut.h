// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "common/cells/cell_complex.h"
#include "stages/graphcut/params.h"

namespace roomcut::graphcut {

struct Graphcut {
  Labels labels;
  double cut_m3 = 0;            ///< least energy of all labellings, the flow
  double unknown_added_m3 = 0;  ///< what leaving out the unknown cells, or making rooms of them, added to it
  double repair_m3 = 0;         ///< what the repair added; negative only where unknown cells were left out
  std::int64_t bad_places = 0;  ///< vertices of the complex where the cut was not manifold
  bool cut_alone = false;       ///< the doubt left no room, so the cut decided without it
  std::int64_t empty_cells = 0;
  std::int64_t unknown_cells = 0;
  double empty_m3 = 0;             ///< volume of the empty cells
  double unobserved_empty_m3 = 0;  ///< the part of it that is unobserved
  double unknown_m3 = 0;           ///< volume of the cells with the third answer
};

/// Labelling of paper §2: one exact max-flow over all cells, with the third answer for what nobody saw
/// (doubt.h), then the repair of the empty cells' surface to a 2-manifold. A cell is `unobserved` when fewer
/// than min_observed of its rays end on a seen face.
/// Deterministic. Throws StageError(kEmptyModel) with the evidence when no cell comes out empty.
Graphcut graphcut(const CellComplex& complex, const FaceWeights& weights, const DataTerms& terms,
                  const GraphcutParams& params);

}  // namespace roomcut::graphcut

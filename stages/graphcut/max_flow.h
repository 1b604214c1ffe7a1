// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/graphcut/energy.h"

namespace roomcut::graphcut {

/// A labelling of least energy, by one max-flow (Boykov-Kolmogorov). Of several optima the one with the
/// fewest empty cells, which is unique: the result does not depend on the order of the graph. `flow_m3` is
/// its energy.
struct Cut {
  std::vector<std::uint8_t> label;
  double flow_m3 = 0;
};

Cut minimum_cut(const CellComplex& complex, const EnergyTerms& terms);

}  // namespace roomcut::graphcut

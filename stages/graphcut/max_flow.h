// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
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

/// Cuts of one complex whose faces keep their costs while the cells change theirs: the graph is made once,
/// and every cut goes on from the flow of the one before. For one thread at a time.
class RepeatedCut {
 public:
  /// `terms`: wall and level count, d_empty and d_solid do not.
  RepeatedCut(const CellComplex& complex, const EnergyTerms& terms);
  RepeatedCut(RepeatedCut&&) noexcept;
  ~RepeatedCut();

  /// What minimum_cut() labels with these d_solid - d_empty, multiples of kQuantum_m3; whatever was cut
  /// before.
  std::vector<std::uint8_t> label(const std::vector<double>& gain_m3);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roomcut::graphcut

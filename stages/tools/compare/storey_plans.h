// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/tools/compare/compare.h"

namespace roomcut::compare {

/// The plans of one storey of two runs, all three of the same part of the plan, as SVG documents. Empty where
/// a run has no such storey.
struct StoreyPlans {
  std::string title;  ///< "Storey 1, floor at 3.10 m"
  std::string a, b;
  /// What only A calls empty in orange, only B in blue, both in light grey; wall lines that moved or that
  /// only one run has.
  std::string difference;
};

/// A plan of every storey, of A's storeys first, cut 1.2 m above the floor.
std::vector<StoreyPlans> draw_storeys(const RunFacts& a, const RunFacts& b, const Comparison& comparison);

}  // namespace roomcut::compare

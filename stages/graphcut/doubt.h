// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/graphcut/energy.h"

namespace roomcut::graphcut {

/// By how much the log-odds of a cell being empty may be wrong, because nobody saw it from inside: from
/// -`invented` to +`denied`. Both are 0 where it was seen.
struct Doubt {
  double invented = 0, denied = 0;
};

/// `doubt` is the largest one [log-odds], `seen` the share of what lies around the cell that was seen from
/// inside, `closed` the share of the directions all around in which something stands. What is closed may be a
/// room that nobody entered, what is open may be outdoors.
Doubt doubt_of(double seen, double closed, double doubt);

/// The optimal labels `cut` with the third answer: two more exact cuts, with the log-odds of all cells at the
/// one and at the other end of their doubt. The labels of such cuts are nested, so whatever the true log-odds
/// in between: what both call empty is empty, what both call solid is solid. What they call differently, in
/// pieces (between likely surfaces) that are wider than a wall, is unknown, and so are slivers of rooms that
/// it cuts off. Deterministic.
std::vector<std::uint8_t> doubtful_labels(const CellComplex& complex, const FaceWeights& weights,
                                          const DataTerms& terms, const EnergyTerms& energy,
                                          const std::vector<std::uint8_t>& cut, double doubt);

}  // namespace roomcut::graphcut

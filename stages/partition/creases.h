// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/plan/plan_segment.h"

namespace roomcut::partition {

/// A line of the plan along which the order of surfaces in the columns beside it changes.
struct Crease {
  PlanSegment segment;
  std::int32_t plane;       ///< of the complex
  std::int32_t layer = -1;  ///< in which stairs rise there; -1 = none
};

/// All creases of the complex's planes over their footprints: where a plane meets a real level (a roof its
/// knee, or the flat part of a ceiling), where two planes meet (ridges, hips, valleys), and between two steps
/// that stand for one plane. Between creases the surfaces of a column are in one order from bottom to top, so
/// that cells between them are well defined (Oesau et al. 2013, §2, whose surfaces are level or upright). In
/// this order; one that runs beside a segment of `walls`, or another crease, all along is left out: nothing
/// measurable fits between.
std::vector<Crease> find_creases(const CellComplex& complex, const std::vector<PlanSegment>& walls);

}  // namespace roomcut::partition

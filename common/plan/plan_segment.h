// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "common/plan/subdivision.h"

namespace roomcut {

/// A part of a line of the plan.
struct PlanSegment {
  Line2 line;
  double t0, t1;  ///< ascending [m] along the line
};

/// Whether an edge lies along the line: both ends within kPlanSnap_m of it, and not just a short edge across
/// it.
bool runs_along(const Subdivision& plan, std::int32_t h, const Line2& line);

/// Length of the edge beside the segment [m]; not positive = it lies beyond the segment's ends.
double overlap(const Subdivision& plan, std::int32_t h, const PlanSegment& segment);

}  // namespace roomcut

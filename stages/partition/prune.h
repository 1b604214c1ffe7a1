// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/plan/plan_segment.h"

namespace roomcut::partition {

/// A face can only be split along its whole chord, so the lines that were cut in first, when faces were
/// large, run on far beyond their reach. This takes away every edge that lies beyond its line's reach,
/// wherever the faces on its two sides are convex together: what stays of a line is its reach, lengthened to
/// the next line that stays. Weak lines go first (`order` lists the line indices, strongest first).
/// Afterwards a building that stands n times side by side has n times the cells of one, and the strongest
/// line of one room does not cut the rooms at the other end.
void prune(Subdivision& plan, const std::vector<PlanSegment>& reach, const std::vector<std::int32_t>& order);

}  // namespace roomcut::partition

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "common/plan/plan_segment.h"

namespace roomcut::partition {

/// Lines on one common carrier (two walls in one row) share the edges that the stronger one cut first. Gives
/// every such edge to the line that reaches most of it, the stronger one when equal. `reach`: the part of
/// every line that cuts; `shared`: pairs (line of an edge, line that runs along it too); `order`: the line
/// indices, strongest first.
void assign_shared_edges(Subdivision& plan, const std::vector<PlanSegment>& reach,
                         const std::set<std::pair<std::int32_t, std::int32_t>>& shared,
                         const std::vector<std::int32_t>& order);

}  // namespace roomcut::partition

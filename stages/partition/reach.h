// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "stages/partition/subdivision.h"

namespace roomcut::partition {

/// A line and the part of it that is to cut: its support, lengthened at both ends.
struct Reach {
  Line2 line;
  double t0, t1;  ///< [m] along the line
};

/// Whether an edge lies along the line: both ends within kPlanSnap_m of it, and not just a short edge across
/// it.
bool runs_along(const Subdivision& plan, std::int32_t h, const Line2& line);

/// Length of the edge that is within reach [m]; not positive = beyond it.
double overlap(const Subdivision& plan, std::int32_t h, const Reach& reach);

/// Lines on one common carrier (two walls in one row) share the edges that the stronger one cut first. Gives
/// every such edge to the line that reaches most of it, the stronger one when equal. `shared` holds pairs
/// (line of an edge, line that runs along it too), `order` the line indices, strongest first.
void assign_shared_edges(Subdivision& plan, const std::vector<Reach>& reach,
                         const std::set<std::pair<std::int32_t, std::int32_t>>& shared,
                         const std::vector<std::int32_t>& order);

}  // namespace roomcut::partition

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/shared_edges.h"

#include <algorithm>

#include "common/cells/cell_complex.h"

namespace roomcut::partition {

void assign_shared_edges(Subdivision& plan, const std::vector<PlanSegment>& reach,
                         const std::set<std::pair<std::int32_t, std::int32_t>>& shared,
                         const std::vector<std::int32_t>& order) {
  std::vector<std::vector<std::int32_t>> others(reach.size());
  for (const auto& [owner, other] : shared) {
    others[owner].push_back(other);
  }
  std::vector<std::size_t> rank(reach.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = i;
  }
  for (std::vector<std::int32_t>& lines : others) {
    std::sort(lines.begin(), lines.end(), [&](std::int32_t a, std::int32_t b) { return rank[a] < rank[b]; });
  }
  for (std::size_t h = 0; h < plan.half_edges.size(); h += 2) {
    const std::int32_t owner = plan.half_edges[h].line;
    if (owner == Subdivision::kNoLine) {
      continue;
    }
    const auto edge = static_cast<std::int32_t>(h);
    double most = overlap(plan, edge, reach[owner]) + kPlanSnap_m;
    for (const std::int32_t other : others[owner]) {
      const double length = overlap(plan, edge, reach[other]);
      if (length > most && length > 0 && runs_along(plan, edge, reach[other].line)) {
        most = length;
        plan.half_edges[h].line = plan.half_edges[h + 1].line = other;
      }
    }
  }
}

}  // namespace roomcut::partition

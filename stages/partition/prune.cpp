// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/prune.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "common/cells/cell_complex.h"
#include "stages/partition/dent.h"

namespace roomcut::partition {

namespace {

/// Rounding may bend a straight side inwards by this much [m].
constexpr double kStraight_m = 1e-10;

/// Whether the edge lies beyond its line's reach.
bool beyond_reach(const Subdivision& plan, const std::vector<PlanSegment>& reach, std::int32_t h) {
  const std::int32_t line = plan.half_edges[h].line;
  if (line == Subdivision::kNoLine || plan.is_removed(h)) {
    return false;
  }
  return overlap(plan, h, reach[line]) <= kPlanSnap_m;
}

/// Whether the corner that is left at the origin of h when h is taken away is convex.
bool convex_without(const Subdivision& plan, std::int32_t h) {
  const std::int32_t into = plan.half_edges[h].prev;
  const std::int32_t out = plan.half_edges[plan.twin(h)].next;
  if (plan.twin(into) == out) {
    return false;  // the edge's end would dangle
  }
  const Vec2 a = plan.from(h) - plan.from(into);
  const Vec2 b = plan.vertices[plan.target(out)] - plan.from(h);
  return a.x() * b.y() - a.y() * b.x() >= -kStraight_m * std::max(a.norm(), b.norm());
}

/// The corners that the two faces beside h have together, counter-clockwise.
std::vector<Vec2> joined_corners(const Subdivision& plan, std::int32_t h) {
  std::vector<Vec2> corners;
  for (const std::int32_t side : {h, plan.twin(h)}) {
    for (std::int32_t walk = plan.half_edges[side].next; walk != side; walk = plan.half_edges[walk].next) {
      corners.push_back(plan.from(walk));
    }
  }
  return corners;
}

/// Whether the two faces beside h are convex together. That a corner turns the right way says it only where
/// its sides are long: a chord that ends in a vertex beside its line turns by up to kPlanSnap_m over its
/// length, unseen at a side of some micrometres, until the far end of that side is dissolved too.
bool convex_together(const Subdivision& plan, std::int32_t h) {
  return convex_without(plan, h) && convex_without(plan, plan.twin(h)) &&
         dent(joined_corners(plan, h)) <= kStraight_m;
}

}  // namespace

void prune(Subdivision& plan, const std::vector<PlanSegment>& reach, const std::vector<std::int32_t>& order) {
  std::vector<std::int32_t> strength(reach.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    strength[order[i]] = static_cast<std::int32_t>(order.size() - i);
  }
  using Entry = std::pair<std::int32_t, std::int32_t>;  // weak lines come out first; then by half-edge
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](std::int32_t h) {
    if (beyond_reach(plan, reach, h)) {
      queue.emplace(strength[plan.half_edges[h].line], h & ~1);
    }
  };
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(plan.half_edges.size()); h += 2) {
    offer(h);
  }
  while (!queue.empty()) {
    const std::int32_t h = queue.top().second;
    queue.pop();
    if (!beyond_reach(plan, reach, h) || !convex_together(plan, h)) {
      continue;
    }
    const std::int32_t face = plan.half_edges[h].face;
    plan.remove_edge(h);
    // The corners of the joined face have changed: what stood against its other edges may have gone.
    std::int32_t walk = plan.face_start[face];
    do {
      offer(walk);
      walk = plan.half_edges[walk].next;
    } while (walk != plan.face_start[face]);
  }
}

}  // namespace roomcut::partition

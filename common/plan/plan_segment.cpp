// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/plan/plan_segment.h"

#include <algorithm>
#include <cmath>

#include "common/cells/cell_complex.h"

namespace roomcut {

bool runs_along(const Subdivision& plan, std::int32_t h, const Line2& line) {
  const Vec2& p = plan.from(h);
  const Vec2& q = plan.vertices[plan.target(h)];
  return std::abs(line.distance(p)) <= kPlanSnap_m && std::abs(line.distance(q)) <= kPlanSnap_m &&
         std::abs(line.along(q) - line.along(p)) > 0.9 * (q - p).norm();
}

double overlap(const Subdivision& plan, std::int32_t h, const PlanSegment& segment) {
  const auto [low, high] =
      std::minmax({segment.line.along(plan.from(h)), segment.line.along(plan.vertices[plan.target(h)])});
  return std::min(high, segment.t1) - std::max(low, segment.t0);
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/spaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roomcut::evaluate {

namespace {

/// The part of a straight line, `start` + z * `up`, within a box; of no length where it passes by.
Interval within(const Bounds3& box, const Vec3& start, const Vec3& up) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  Interval part{-kAll, kAll};
  for (int axis = 0; axis < 3; ++axis) {
    if (up[axis] == 0) {
      if (start[axis] < box.lo[axis] || start[axis] > box.hi[axis]) {
        return {0, 0};
      }
      continue;
    }
    const double a = (box.lo[axis] - start[axis]) / up[axis];
    const double b = (box.hi[axis] - start[axis]) / up[axis];
    part.lo = std::max(part.lo, std::min(a, b));
    part.hi = std::min(part.hi, std::max(a, b));
  }
  return part;
}

}  // namespace

bool IgnoredSpace::contains(const Vec3& p) const {
  const Vec3 q = axes_.to_file(p);
  return std::any_of(boxes_.begin(), boxes_.end(), [&q](const Bounds3& box) {
    return (q.array() >= box.lo.array()).all() && (q.array() <= box.hi.array()).all();
  });
}

void IgnoredSpace::at(double x, double y, const std::vector<Interval>& truth_parts,
                      std::vector<Interval>& out) const {
  out.clear();
  const Vec3 start = axes_.to_file({x, y, 0});
  const Vec3 up = axes_.turn.transpose() * Vec3(0, 0, 1);
  std::vector<Interval> parts;
  for (const Bounds3& box : boxes_) {
    const Interval part = within(box, start, up);
    if (part.hi > part.lo) {
      parts.push_back(part);
    }
  }
  if (!parts.empty()) {
    unite(parts);
    subtract(parts, truth_parts, out);
  }
}

void LabelledSpace::at(double x, double y, std::vector<Interval>& out) const {
  out.clear();
  const std::int32_t face = locator_.face_at({x, y});
  for (std::size_t k = 0; face >= 0 && k < complex_.layers(); ++k) {
    if (label_[complex_.cell(static_cast<std::size_t>(face), k)] == wanted_) {
      out.push_back({complex_.levels[k], complex_.levels[k + 1]});
    }
  }
}

}  // namespace roomcut::evaluate

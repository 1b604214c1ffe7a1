// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <tuple>

#include "common/wall_lines/edit_document.h"

namespace roomcut {

namespace {

constexpr double kOn_m = 1e-3;  ///< of both ends: an unmoved line, whatever program saved it

bool lies_on(const Vec2& a, const Vec2& b, const WallLine& line) {
  const auto same = [](const Vec2& p, const Vec2& q) { return (p - q).norm() <= kOn_m; };
  return (same(a, line.a) && same(b, line.b)) || (same(a, line.b) && same(b, line.a));
}

/// How well lines fit the base in some coordinates; compared member by member.
struct Fit {
  std::size_t unmoved = 0;  ///< lines that lie on one of the base
  std::size_t inside = 0;   ///< lines that lie in the scan
  bool operator>(const Fit& other) const {
    return std::tie(unmoved, inside) > std::tie(other.unmoved, other.inside);
  }
};

Fit fit_of(const std::vector<DrawnLine>& drawn, const EditPlan& plan, const WallLines& base) {
  const PlanBox allowed = allowed_box(base.bbox_min, base.bbox_max);
  Fit fit;
  for (const DrawnLine& d : drawn) {
    const Vec2 a = plan.to_base(d.line.a);
    const Vec2 b = plan.to_base(d.line.b);
    const auto on = [&](const WallLine& line) { return lies_on(a, b, line); };
    fit.unmoved += std::any_of(base.lines.begin(), base.lines.end(), on) ? 1 : 0;
    fit.inside += allowed.holds(a) && allowed.holds(b) ? 1 : 0;
  }
  return fit;
}

}  // namespace

LineCoordinates judge_coordinates(const std::vector<DrawnLine>& drawn, const WallLines& base,
                                  EditReport& report) {
  const Frame& frame = base.frame;
  if (frame.origin[0] == 0 && frame.origin[1] == 0 && !frame.levelled()) {
    return LineCoordinates::kScan;  // both are the same
  }
  const Fit scan = fit_of(drawn, EditPlan(LineCoordinates::kScan, frame, frame), base);
  const Fit local = fit_of(drawn, EditPlan(LineCoordinates::kLocal, frame, frame), base);
  const bool taken = scan > local;
  report.warn(
      "", std::string("its lines are taken for ") +
              (taken ? "the scan's own coordinates" : "local coordinates (the frame's origin subtracted)") +
              ": so " + std::to_string((taken ? scan : local).unmoved) +
              " of them lie on lines of the detection, else " +
              std::to_string((taken ? local : scan).unmoved));
  return taken ? LineCoordinates::kScan : LineCoordinates::kLocal;
}

}  // namespace roomcut

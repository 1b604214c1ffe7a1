// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/errors/codes.h"
#include "common/wall_lines/edit_document.h"

namespace roomcut {

namespace {

constexpr double kShrunk = 1e-3;  ///< a whole plan smaller than this share of the scan was reprojected

struct Box {
  Vec2 low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  Vec2 high{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  void add(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double diagonal() const { return (high - low).norm(); }
};

/// Whether all points of `points` lie in `allowed` after p -> to_local(scale * p).
template <class ToLocal>
bool fits(const Box& points, const PlanBox& allowed, double scale, ToLocal to_local) {
  return allowed.holds(to_local(scale * points.low)) && allowed.holds(to_local(scale * points.high));
}

OutsideCause other_coordinates(const EditPlan& plan) {
  if (plan.coordinates() == LineCoordinates::kScan) {
    return {"these look like local coordinates, as files of version 1.0 have them",
            R"(write "coordinates": "local" in the member `roomcut`)"};
  }
  return {"these look like the scan's own coordinates",
          R"(write "coordinates": "scan" in the member `roomcut`)"};
}

OutsideCause likely_cause(const Box& points, const PlanBox& allowed, const EditPlan& plan,
                          const Frame& frame) {
  const auto to_base = [&](const Vec2& p) { return plan.to_base(p); };
  const EditPlan other(
      plan.coordinates() == LineCoordinates::kScan ? LineCoordinates::kLocal : LineCoordinates::kScan, frame,
      frame);
  if (fits(points, allowed, 1, [&](const Vec2& p) { return other.to_base(p); })) {
    return other_coordinates(plan);
  }
  if (points.low.x() >= -180 && points.high.x() <= 180 && points.low.y() >= -90 && points.high.y() <= 90) {
    return {"these look like degrees",
            "save the layer in the coordinate system of the scan, without reprojecting to WGS 84"};
  }
  if (fits(points, allowed, 1e-3, to_base)) {
    return {"these look like millimetres", "scale the coordinates to metres"};
  }
  if (fits(points, allowed, 1e-2, to_base)) {
    return {"these look like centimetres", "scale the coordinates to metres"};
  }
  return {"neither degrees, millimetres nor the scan's own or local coordinates would fit",
          "move it into the scan, or delete the feature"};
}

void check_lengths(const std::vector<DrawnLine>& drawn, EditReport& report) {
  for (const DrawnLine& d : drawn) {
    if (d.line.length() < kShortestLine_m) {
      report.problem(errors::kLinesDegenerate, feature_place(d.feature, d.line.id), "both ends are equal",
                     "delete the feature or move an end");
    }
  }
}

}  // namespace

bool PlanBox::holds(const Vec2& p) const {
  return p.x() >= low.x() && p.y() >= low.y() && p.x() <= high.x() && p.y() <= high.y();
}

PlanBox allowed_box(const Vec2& bbox_min, const Vec2& bbox_max) {
  const double margin = 0.5 * (bbox_max - bbox_min).norm();
  return {bbox_min - Vec2(margin, margin), bbox_max + Vec2(margin, margin)};
}

OutsideCause outside_cause(const Vec2& low, const Vec2& high, const PlanBox& allowed, const EditPlan& plan,
                           const Frame& base_frame) {
  return likely_cause({low, high}, allowed, plan, base_frame);
}

void check_edit_extent(const std::vector<DrawnLine>& drawn, const EditPlan& plan, const WallLines& base,
                       EditReport& report) {
  const PlanBox allowed = allowed_box(base.bbox_min, base.bbox_max);
  const auto outside = [&](const DrawnLine& d) {
    return !allowed.holds(plan.to_base(d.line.a)) || !allowed.holds(plan.to_base(d.line.b));
  };
  Box all;
  for (const DrawnLine& d : drawn) {
    all.add(d.line.a);
    all.add(d.line.b);
  }
  const auto count = static_cast<std::size_t>(std::count_if(drawn.begin(), drawn.end(), outside));
  const bool shrunk = drawn.size() > 1 && all.diagonal() < kShrunk * (base.bbox_max - base.bbox_min).norm();
  if (!shrunk) {
    check_lengths(drawn, report);
  }
  if (count == drawn.size() || shrunk) {
    if (!drawn.empty()) {
      const OutsideCause cause =
          shrunk ? OutsideCause{"these look like degrees",
                                "save the layer in the coordinate system of the scan, in metres"}
                 : likely_cause(all, allowed, plan, base.frame);
      report.problem(errors::kLinesOutside, "all " + std::to_string(drawn.size()) + " lines",
                     (shrunk ? "lie on one spot: " : "lie far outside the scan: ") + cause.what, cause.hint);
    }
    return;
  }
  for (const DrawnLine& d : drawn) {
    if (outside(d)) {
      Box one;
      one.add(d.line.a);
      one.add(d.line.b);
      const OutsideCause cause = likely_cause(one, allowed, plan, base.frame);
      report.problem(errors::kLinesOutside, feature_place(d.feature, d.line.id),
                     "lies far outside the scan: " + cause.what, cause.hint);
    }
  }
}

}  // namespace roomcut

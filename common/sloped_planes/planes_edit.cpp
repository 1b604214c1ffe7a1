// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "common/geometry/convex_hull.h"
#include "common/sloped_planes/planes_features.h"
#include "common/sloped_planes/planes_format.h"
#include "common/sloped_planes/planes_io.h"

namespace roomcut {

namespace {

constexpr double kDegToRad = std::numbers::pi / 180.0;

/// Planes as the base has them: in the scan's own coordinates, outlines local.
DrawnPlane in_base(DrawnPlane drawn, const EditPlan& plan, const Frame& base) {
  const ScanCoordinates scan(base);
  if (plan.coordinates() == LineCoordinates::kLocal) {
    const Vec2 middle = middle_of(drawn.outline);
    if (drawn.height_m) {
      *drawn.height_m =
          scan.height_to_scan(plan.to_base(middle), plan.height_to_base(middle, *drawn.height_m));
    }
    if (drawn.uphill_deg) {
      const double angle = *drawn.uphill_deg * kDegToRad;
      const Vec2 uphill = scan.plan_turn() * plan.direction_to_base(Vec2(std::cos(angle), std::sin(angle)));
      *drawn.uphill_deg = std::atan2(uphill.y(), uphill.x()) / kDegToRad;
    }
  }
  for (Vec2& corner : drawn.outline) {
    corner = plan.to_base(corner);
  }
  drawn.outline = convex_hull(std::move(drawn.outline));
  return drawn;
}

bool inside(const DrawnPlane& drawn, const EditPlan& plan, const PlanBox& allowed) {
  return std::all_of(drawn.outline.begin(), drawn.outline.end(),
                     [&](const Vec2& corner) { return allowed.holds(plan.to_base(corner)); });
}

/// Those planes, as the base has them, of which more can be said.
std::vector<DrawnPlane> placed(const std::vector<DrawnPlane>& drawn, const EditPlan& plan,
                               const AcceptedPlanes& base, EditReport& report) {
  const PlanBox allowed = allowed_box(base.bbox_min, base.bbox_max);
  std::vector<DrawnPlane> result;
  for (const DrawnPlane& d : drawn) {
    if (!inside(d, plan, allowed)) {
      Vec2 low = d.outline[0], high = d.outline[0];
      for (const Vec2& corner : d.outline) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
      }
      const OutsideCause cause = outside_cause(low, high, allowed, plan, base.frame);
      report.problem(errors::kLinesOutside, place_of(d), "lies far outside the scan: " + cause.what,
                     cause.hint);
      continue;
    }
    DrawnPlane there = in_base(d, plan, base.frame);
    if (there.outline.size() < 3 || 0.5 * turned_area(there.outline) < kSmallestOutline_m2) {
      report.problem(errors::kLinesDegenerate, place_of(d), "its outline has no area to speak of",
                     "draw it in metres, over the floor or ceiling that slopes, or delete the feature");
      continue;
    }
    result.push_back(std::move(there));
  }
  return result;
}

LineCoordinates judge(const std::vector<DrawnPlane>& drawn, const AcceptedPlanes& base) {
  const PlanBox allowed = allowed_box(base.bbox_min, base.bbox_max);
  const auto fits = [&](LineCoordinates coordinates) {
    const EditPlan plan(coordinates, base.frame, base.frame);
    return std::count_if(drawn.begin(), drawn.end(),
                         [&](const DrawnPlane& d) { return inside(d, plan, allowed); });
  };
  return fits(LineCoordinates::kLocal) > fits(LineCoordinates::kScan) ? LineCoordinates::kLocal
                                                                      : LineCoordinates::kScan;
}

}  // namespace

PlanesFile read_edited_planes(const std::filesystem::path& path, const AcceptedPlanes& base) {
  EditReport report{kPlanesEdit, path.string(), {}, {}};
  const Json document = read_edit_document(path, report);
  const EditOrigin origin = read_edit_member(document, base.frame, report);
  const std::vector<DrawnPlane> drawn = read_plane_features(document["features"], report);
  const LineCoordinates coordinates = origin.coordinates ? *origin.coordinates : judge(drawn, base);
  if (!origin.coordinates && coordinates == LineCoordinates::kLocal) {
    report.warn("", "its planes are taken for local coordinates (the frame's origin subtracted)");
  }
  const EditPlan plan(coordinates, origin.frame, base.frame);
  PlanesFile file;
  file.content = base;
  file.content.base_sha256 = origin.base_sha256;
  file.content.planes = identify_planes(placed(drawn, plan, base, report), base, report);
  if (!report.problems.empty()) {
    throw StageError(report.problems);
  }
  file.content = normalised_planes(std::move(file.content));
  file.payload_sha256 = planes_payload_sha256(file.content);
  file.warnings = std::move(report.warnings);
  return file;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/cut_jambs.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/cells/face_locator.h"
#include "common/plan/plan_complex.h"
#include "common/plan/segment_inserter.h"

namespace roomcut::extract {

namespace {

/// The jamb through `at`, across the opening, from face to face of the wall. None where they are not across.
std::optional<PlanSegment> jamb_of(const Opening& opening, const Vec2& at, const Line2& a, const Line2& b) {
  const Vec2 along = (opening.jamb_b - opening.jamb_a).normalized();
  const Vec2 across(-along.y(), along.x());
  const auto foot = [&](const Line2& face) -> Vec2 {
    return at - face.distance(at) / face.normal().dot(across) * across;
  };
  if (std::abs(a.normal().dot(across)) < 0.5 || std::abs(b.normal().dot(across)) < 0.5 ||
      (foot(a) - foot(b)).norm() < 10 * kPlanSnap_m) {
    return std::nullopt;
  }
  PlanSegment jamb{line_through(foot(a), foot(b)), 0, 0};
  std::tie(jamb.t0, jamb.t1) = std::minmax({jamb.line.along(foot(a)), jamb.line.along(foot(b))});
  return jamb;
}

}  // namespace

std::optional<std::int32_t> line_index(const CellComplex& complex, const std::string& wall_id) {
  for (std::size_t i = 0; i < complex.lines.size(); ++i) {
    if (complex.lines[i].wall_id == wall_id) {
      return static_cast<std::int32_t>(i);
    }
  }
  return std::nullopt;
}

CellComplex with_jambs(const CellComplex& complex, const std::vector<Opening>& openings,
                       std::vector<std::int32_t>& parent) {
  CellComplex result = complex;
  Subdivision plan = plan_of(complex);
  SegmentInserter inserter(plan);
  const FaceLocator locator(complex);
  const auto cut = [&](const PlanSegment& jamb, const std::string& id) {
    const auto line = static_cast<std::int32_t>(result.lines.size());
    result.lines.push_back({id, jamb.line, jamb.t0, jamb.t1, {}});
    const std::int32_t face = locator.face_at(jamb.line.at(0.5 * (jamb.t0 + jamb.t1)));
    if (face >= 0) {
      inserter.insert(jamb, line, face);
    }
  };
  for (const Opening& opening : openings) {
    const auto a = line_index(complex, opening.wall_a);
    const auto b = line_index(complex, opening.wall_b);
    if (!a || !b) {
      continue;
    }
    const Line2& face_a = complex.lines[static_cast<std::size_t>(*a)].line;
    const Line2& face_b = complex.lines[static_cast<std::size_t>(*b)].line;
    const auto first = jamb_of(opening, opening.jamb_a, face_a, face_b);
    const auto second = jamb_of(opening, opening.jamb_b, face_a, face_b);
    if (first && second) {
      cut(*first, opening.id + ".a");
      cut(*second, opening.id + ".b");
    }
  }
  const std::vector<std::int32_t> faces = plan.faces_in_tree_order();
  parent.clear();
  for (const std::int32_t face : faces) {
    parent.push_back(plan.original[face]);
  }
  set_plan(plan, faces, result);
  return result;
}

}  // namespace roomcut::extract

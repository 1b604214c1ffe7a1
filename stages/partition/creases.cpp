// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/creases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/cells/stairs.h"

namespace roomcut::partition {

namespace {

constexpr double kRim_m = 0.3;        // from the outermost points of a plane to the walls' middle
constexpr double kMeet_m = 0.6;       // from the points of two planes to where they meet
constexpr double kShortest_m = 0.05;  // of a crease
constexpr double kBeside_m = 0.04;    // a crease this near to a line is that line
constexpr double kFlattest = 1e-4;    // rise per metre below which two surfaces do not meet in a line

/// Where gradient · p + c is zero; nothing for surfaces that are as good as parallel.
std::optional<Line2> zero_line(const Vec2& gradient, double c) {
  const double steepness = gradient.norm();
  if (steepness < kFlattest) {
    return std::nullopt;
  }
  return normalised(std::atan2(gradient.y(), gradient.x()), -c / steepness);
}

/// Narrows the segment to the part over the plane's footprint, widened by a margin.
void clip(const SlopedPlane& plane, double margin_m, PlanSegment& segment) {
  const Vec2 start = segment.line.at(0);
  const Vec2 direction = segment.line.direction();
  for (std::size_t i = 0; i < plane.outline.size(); ++i) {
    const Vec2& a = plane.outline[i];
    const Vec2 along = (plane.outline[i + 1 < plane.outline.size() ? i + 1 : 0] - a).normalized();
    const Vec2 inward(-along.y(), along.x());
    const double off = inward.dot(start - a) + margin_m;
    const double slope = inward.dot(direction);
    if (std::abs(slope) < 1e-12) {
      if (off < 0) {
        segment.t1 = segment.t0;
      }
      continue;
    }
    (slope > 0 ? segment.t0 : segment.t1) =
        slope > 0 ? std::max(segment.t0, -off / slope) : std::min(segment.t1, -off / slope);
  }
}

PlanSegment whole(const Line2& line) {
  constexpr double kFar = std::numeric_limits<double>::max();
  return {line, -kFar, kFar};
}

/// Whether the segment runs within kBeside_m of another one from end to end.
bool runs_beside(const PlanSegment& segment, const PlanSegment& other) {
  const auto near = [&](double t) {
    const Vec2 p = segment.line.at(t);
    const double along = other.line.along(p);
    return std::abs(other.line.distance(p)) < kBeside_m && along > other.t0 - kBeside_m &&
           along < other.t1 + kBeside_m;
  };
  return near(segment.t0) && near(segment.t1);
}

class CreaseFinder {
 public:
  CreaseFinder(const CellComplex& complex, const std::vector<PlanSegment>& walls)
      : complex_(complex), taken_(walls) {}

  std::vector<Crease> find() {
    const Stairs stairs(complex_.levels, complex_.steps);
    for (std::size_t i = 0; i < complex_.planes.size(); ++i) {
      for (std::size_t l = 0; l < complex_.levels.size(); ++l) {
        if (!stairs.is_step(l)) {
          at_height(i, complex_.levels[l], -1);
        }
      }
    }
    for (std::size_t i = 0; i < complex_.planes.size(); ++i) {
      for (std::size_t j = i + 1; j < complex_.planes.size(); ++j) {
        between(i, j);
      }
    }
    for (std::size_t i = 0; i < complex_.planes.size(); ++i) {
      for (std::size_t k = 0; k < complex_.layers(); ++k) {
        if (stairs.has_riser(k)) {
          at_height(i, stairs.riser(k), static_cast<std::int32_t>(k));
        }
      }
    }
    return std::move(creases_);
  }

 private:
  void at_height(std::size_t i, double z, std::int32_t layer) {
    const SlopedPlane& plane = complex_.planes[i];
    if (const std::optional<Line2> line = zero_line(plane.gradient, plane.c - z)) {
      PlanSegment segment = whole(*line);
      clip(plane, kRim_m, segment);
      add({segment, static_cast<std::int32_t>(i), layer});
    }
  }

  void between(std::size_t i, std::size_t j) {
    const SlopedPlane& a = complex_.planes[i];
    const SlopedPlane& b = complex_.planes[j];
    if (const std::optional<Line2> line = zero_line(a.gradient - b.gradient, a.c - b.c)) {
      PlanSegment segment = whole(*line);
      clip(a, kMeet_m, segment);
      clip(b, kMeet_m, segment);
      add({segment, static_cast<std::int32_t>(i)});
    }
  }

  void add(const Crease& crease) {
    if (!(crease.segment.t1 - crease.segment.t0 > kShortest_m) ||
        std::any_of(taken_.begin(), taken_.end(),
                    [&](const PlanSegment& other) { return runs_beside(crease.segment, other); })) {
      return;
    }
    taken_.push_back(crease.segment);
    creases_.push_back(crease);
  }

  const CellComplex& complex_;
  std::vector<PlanSegment> taken_;
  std::vector<Crease> creases_;
};

}  // namespace

std::vector<Crease> find_creases(const CellComplex& complex, const std::vector<PlanSegment>& walls) {
  return CreaseFinder(complex, walls).find();
}

}  // namespace roomcut::partition

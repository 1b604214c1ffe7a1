// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/merge_lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace roomcut::refine_lines {

namespace {

constexpr double kReach_m = 4.5;  ///< partition extends both lines by 2 m: nearer ones would run side by side
constexpr double kSignificant = 3.0;  ///< standard deviations
constexpr double kInsignificant_m = 0.004;

struct Interval {
  double low, high;
};

Interval along(const Line2& line, const LineFaces& faces) {
  const double a = line.along(faces.line.at(faces.t0));
  const double b = line.along(faces.line.at(faces.t1));
  return {std::min(a, b), std::max(a, b)};
}

/// What two lines have in common, place by place and layer by layer.
struct Common {
  bool any = false;  ///< both carry surface somewhere at one place and height
  bool solid_between = false;
};

Common compare_faces(const MergeCandidate& strong, const MergeCandidate& weak, double offset) {
  Common common;
  const LineFaces& a = *strong.faces;
  const LineFaces& b = *weak.faces;
  const bool turned = a.line.normal().dot(b.line.normal()) < 0;
  for (std::size_t bin = 0; bin < b.bins; ++bin) {
    const Vec2 place = b.line.at(b.t0 + (static_cast<double>(bin) + 0.5) * b.bin_m);
    const double t = (a.line.along(place) - a.t0) / a.bin_m;
    if (t < 0 || t >= static_cast<double>(a.bins)) {
      continue;
    }
    for (std::size_t layer = 0; layer < b.layers; ++layer) {
      const int side_a = a.side_at(static_cast<std::size_t>(t), layer);
      const int side_b = b.side_at(bin, layer) * (turned ? -1 : 1);
      common.any = common.any || (side_a != 0 && side_b != 0);
      // Opposite faces, each looking away from the other.
      common.solid_between = common.solid_between || (side_a * side_b < 0 && side_a * offset <= 0);
    }
  }
  return common;
}

bool goes_into(const MergeCandidate& weak, const MergeCandidate& strong, double distance_m,
               double angle_rad) {
  if (weak.users || angle_between(weak.line.theta, strong.line.theta) > angle_rad) {
    return false;
  }
  const double offset = strong.line.distance(weak.centre);
  if (std::abs(offset) > distance_m) {
    return false;
  }
  const Interval own = along(strong.line, *weak.faces);
  const Interval other = along(strong.line, *strong.faces);
  if (own.low > other.high + kReach_m || other.low > own.high + kReach_m) {
    return false;
  }
  const Vec2 ends[2] = {weak.faces->line.at(weak.faces->t0), weak.faces->line.at(weak.faces->t1)};
  for (const Vec2& end : ends) {
    const Vec2 on_weak = end - weak.line.distance(end) * weak.line.normal();
    if (std::abs(strong.line.distance(on_weak)) > 2 * distance_m) {
      return false;
    }
  }
  const Common common = compare_faces(strong, weak, offset);
  const double sigma = std::hypot(weak.sigma_m, strong.sigma_m);
  return !common.solid_between &&
         (common.any || std::abs(offset) <= std::max(kInsignificant_m, kSignificant * sigma));
}

}  // namespace

std::vector<std::size_t> find_merges(const std::vector<MergeCandidate>& candidates, double distance_m,
                                     double angle_rad) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const MergeCandidate& a = candidates[i];
    const MergeCandidate& b = candidates[j];
    return a.users != b.users ? a.users : a.strength != b.strength ? a.strength > b.strength : a.id < b.id;
  });
  std::vector<std::size_t> into(candidates.size());
  std::iota(into.begin(), into.end(), 0U);
  for (std::size_t k = 1; k < order.size(); ++k) {
    for (std::size_t s = 0; s < k; ++s) {
      if (into[order[s]] == order[s] &&
          goes_into(candidates[order[k]], candidates[order[s]], distance_m, angle_rad)) {
        into[order[k]] = order[s];
        break;
      }
    }
  }
  return into;
}

}  // namespace roomcut::refine_lines

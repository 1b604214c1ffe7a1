// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/merge_lines.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace roomcut::detect_lines {
namespace {

Vec2 centre(const LineCandidate& candidate) {
  return candidate.line.at(0.5 * (candidate.support.t0 + candidate.support.t1));
}

bool stronger(const LineCandidate& a, const LineCandidate& b) {
  return std::make_tuple(-a.support.support_m, a.line.theta, a.line.d, a.support.t0) <
         std::make_tuple(-b.support.support_m, b.line.theta, b.line.d, b.support.t0);
}

/// The weaker line's interval, seen along the stronger one.
std::pair<double, double> interval_on(const Line2& line, const LineCandidate& weaker) {
  const double a = line.along(weaker.line.at(weaker.support.t0));
  const double b = line.along(weaker.line.at(weaker.support.t1));
  return std::minmax(a, b);
}

/// Whether the stronger line is a wall beside the weaker one in one of its slices: what lies in front of a
/// wall does so in one storey.
bool share_a_slice(const WallCells& cells, const LineCandidate& kept, const LineCandidate& weaker,
                   double reach_m) {
  std::set<std::int32_t> slices;
  for (const std::uint32_t i : weaker.support.cells) slices.insert(cells.slice[i]);
  const std::pair<double, double> place = interval_on(kept.line, weaker);
  return std::any_of(kept.support.cells.begin(), kept.support.cells.end(), [&](std::uint32_t i) {
    const double t = kept.line.along({cells.x[i], cells.y[i]});
    return t >= place.first - reach_m && t <= place.second + reach_m && slices.contains(cells.slice[i]);
  });
}

bool duplicates(const WallCells& cells, const LineCandidate& kept, const LineCandidate& weaker,
                const MergeRules& rules) {
  if (angle_between(kept.line.theta, weaker.line.theta) >= rules.angle_rad) return false;
  const auto [t0, t1] = interval_on(kept.line, weaker);
  const bool beside = t0 >= kept.support.t0 && t1 <= kept.support.t1 &&
                      weaker.support.support_m < rules.minor_share * kept.support.support_m;
  const double apart = std::abs(kept.line.distance(centre(weaker)));
  const bool minor =
      beside && apart < rules.minor_distance_m && share_a_slice(cells, kept, weaker, rules.minor_reach_m);
  if (apart >= rules.distance_m && !minor) return false;
  return t0 <= kept.support.t1 + rules.reach_m && t1 >= kept.support.t0 - rules.reach_m;
}

void take_over(const WallCells& cells, LineCandidate& kept, const LineCandidate& weaker,
               const FitRules& fit) {
  CellIndices joined;
  std::merge(kept.support.cells.begin(), kept.support.cells.end(), weaker.support.cells.begin(),
             weaker.support.cells.end(), std::back_inserter(joined));
  FitRules one_piece = fit;
  one_piece.max_gap_m = 1e9;
  double support_m = 0;
  for (const Support& support : supports(cells, joined, kept.line, one_piece)) support_m += support.support_m;
  const auto [t0, t1] = interval_on(kept.line, weaker);
  kept.support = {std::min(kept.support.t0, t0), std::max(kept.support.t1, t1), support_m, std::move(joined)};
}

}  // namespace

std::vector<LineCandidate> merge_near_duplicates(const WallCells& cells, std::vector<LineCandidate> lines,
                                                 const MergeRules& rules, const FitRules& fit) {
  std::sort(lines.begin(), lines.end(), stronger);
  std::vector<LineCandidate> kept;
  for (LineCandidate& line : lines) {
    const auto twin = std::find_if(kept.begin(), kept.end(),
                                   [&](const LineCandidate& k) { return duplicates(cells, k, line, rules); });
    if (twin == kept.end()) {
      kept.push_back(std::move(line));
    } else {
      take_over(cells, *twin, line, fit);
    }
  }
  std::sort(kept.begin(), kept.end(), stronger);
  return kept;
}

}  // namespace roomcut::detect_lines

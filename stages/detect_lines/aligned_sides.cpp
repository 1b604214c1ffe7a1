// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/aligned_sides.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace roomcut::detect_lines {
namespace {

constexpr double kGap_m = 10;     // sides farther apart are no row
constexpr double kGapSides = 25;  // nor are those farther apart than so many of their lengths

/// Gives sides [begin, end), of one line's direction, their mean, and joins those that follow each other.
void add_row(std::vector<Side>::iterator begin, std::vector<Side>::iterator end,
             std::vector<LineCandidate>& lines) {
  double sum = 0, weight = 0;
  for (auto side = begin; side != end; ++side) {
    sum += side->support.support_m * side->line.d;
    weight += side->support.support_m;
  }
  std::sort(begin, end, [](const Side& a, const Side& b) { return a.support.t0 < b.support.t0; });
  const std::size_t first = lines.size();
  for (auto side = begin; side != end; ++side) {
    const double reach = std::min(kGap_m, kGapSides * (side->support.t1 - side->support.t0));
    const bool joins = lines.size() > first && side->support.t0 - lines.back().support.t1 < reach;
    if (!joins) {
      lines.push_back(
          {{side->line.theta, weight > 0 ? sum / weight : side->line.d}, side->support, side->column});
      continue;
    }
    LineCandidate& line = lines.back();
    line.support.t1 = std::max(line.support.t1, side->support.t1);
    line.support.support_m += side->support.support_m;
    line.support.cells.insert(line.support.cells.end(), side->support.cells.begin(),
                              side->support.cells.end());
    line.column += " " + side->column;
  }
}

}  // namespace

std::vector<LineCandidate> align_sides(std::vector<Side> sides, double aligned_m) {
  constexpr double kSameAngle = 1e-9;
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::make_tuple(std::round(a.line.theta / kSameAngle), a.line.d, a.support.t0) <
           std::make_tuple(std::round(b.line.theta / kSameAngle), b.line.d, b.support.t0);
  });
  std::vector<LineCandidate> lines;
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if(begin, sides.end(), [&](const Side& side) {
      return std::abs(side.line.theta - begin->line.theta) > kSameAngle ||
             side.line.d - begin->line.d > aligned_m;
    });
    const auto next = end;
    add_row(begin, end, lines);
    begin = next;
  }
  std::stable_sort(lines.begin(), lines.end(), [](const LineCandidate& a, const LineCandidate& b) {
    return a.support.support_m > b.support.support_m;
  });
  return lines;
}

}  // namespace roomcut::detect_lines

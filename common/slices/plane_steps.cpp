// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/slices/plane_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roomcut {
namespace {

constexpr double kClearance_m = 0.1;  ///< of steps from other levels

using Interval = std::pair<double, double>;

/// What the planes cover between two heights, largest plane first.
std::vector<Interval> covered(const std::vector<SlopedPlane>& planes, double lo, double hi) {
  std::vector<Interval> intervals;
  for (const SlopedPlane& plane : planes) {
    const auto [low, high] = plane.range();
    const Interval inside{std::max(low, lo), std::min(high, hi)};
    if (inside.second - inside.first > kPassesLevel_m) intervals.push_back(inside);
  }
  return intervals;
}

/// Intervals that overlap, or nearly, as one; ascending.
std::vector<Interval> joined(std::vector<Interval> intervals, double near) {
  std::sort(intervals.begin(), intervals.end());
  std::vector<Interval> unions;
  for (const Interval& next : intervals) {
    if (!unions.empty() && next.first < unions.back().second + near) {
      unions.back().second = std::max(unions.back().second, next.second);
    } else {
      unions.push_back(next);
    }
  }
  return unions;
}

/// Heights of the steps between two levels.
std::vector<double> steps_between(const std::vector<SlopedPlane>& planes, double lo, double hi,
                                  double step_m) {
  std::vector<double> steps;
  if (hi - lo < 2 * kClearance_m) return steps;
  const auto clear = [&](double z) { return std::clamp(z, lo + kClearance_m, hi - kClearance_m); };
  const std::vector<Interval> intervals = covered(planes, lo, hi);
  for (const auto& [low, high] : joined(intervals, 0.5 * step_m)) {
    const auto n = std::max(1L, std::lround((high - low) / step_m));
    for (long i = 0; i < n; ++i) {
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
      steps.push_back(clear(low + share * (high - low)));
    }
  }
  for (const auto& [low, high] : intervals) {
    const auto stands_for_it = [low = low, high = high](double z) {
      return z > low - 0.5 * kClearance_m && z < high + 0.5 * kClearance_m;
    };
    if (std::none_of(steps.begin(), steps.end(), stands_for_it)) steps.push_back(clear(0.5 * (low + high)));
  }
  return steps;
}

/// Steps of the planes between all pairs of neighbouring levels.
std::vector<Level> plane_steps(const std::vector<Level>& levels, const std::vector<SlopedPlane>& planes,
                               double step_m) {
  std::vector<Level> steps;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    for (const double z : steps_between(planes, levels[k].z, levels[k + 1].z, step_m)) {
      steps.push_back(step_level(z));
    }
  }
  return steps;
}

void sort_by_height(std::vector<Level>& levels) {
  std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.z < b.z; });
}

/// Caps beyond planes that go on above the last level, or below the first. A cap that is there moves.
void close_over(std::vector<Level>& levels, const std::vector<SlopedPlane>& planes) {
  const auto [bottom, top] = heights_of(planes);
  if (top > levels.back().z + kPassesLevel_m) {
    if (levels.back().cap) levels.pop_back();
    levels.push_back(cap_level(top + kCloses_m));
  }
  if (bottom < levels.front().z - kPassesLevel_m) {
    if (levels.front().cap) levels.erase(levels.begin());
    levels.insert(levels.begin(), cap_level(bottom - kCloses_m));
  }
}

}  // namespace

Level cap_level(double z) {
  return {z, z, z, 0, 0, true};
}

Level step_level(double z) {
  return {z, z, z, 0, 0, false, true};
}

std::pair<double, double> heights_of(const std::vector<SlopedPlane>& planes) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const SlopedPlane& plane : planes) {
    const auto [from, to] = plane.range();
    low = std::min(low, from);
    high = std::max(high, to);
  }
  return {low, high};
}

void add_steps(std::vector<Level>& levels, const std::vector<SlopedPlane>& planes,
               const std::vector<Level>& others, double step_m) {
  const std::vector<Level> steps = plane_steps(levels, planes, step_m);
  levels.insert(levels.end(), steps.begin(), steps.end());
  const std::size_t known = levels.size();
  for (const Level& step : others) {
    const bool clear = std::all_of(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(known),
                                   [&](const Level& l) { return std::abs(l.z - step.z) >= 0.5 * step_m; });
    if (clear) levels.push_back(step);
  }
  sort_by_height(levels);
}

std::vector<Level> levels_with_planes(const std::vector<Level>& levels,
                                      const std::vector<SlopedPlane>& before,
                                      const std::vector<SlopedPlane>& after, double step_m) {
  std::vector<Level> result, others;
  for (const Level& level : levels) (level.step ? others : result).push_back(level);
  if (step_m <= 0 || result.empty()) return levels;
  const std::vector<Level> former = plane_steps(result, before, step_m);
  std::erase_if(others, [&](const Level& step) {
    return std::any_of(former.begin(), former.end(), [&](const Level& l) { return l.z == step.z; });
  });
  close_over(result, after);
  add_steps(result, after, others, step_m);
  return result;
}

}  // namespace roomcut

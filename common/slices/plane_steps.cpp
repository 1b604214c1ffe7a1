// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/slices/plane_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace roomcut {
namespace {

constexpr double kClearance_m = 0.1;  ///< of steps from other levels

constexpr double kSmall_m2 =
    10;  ///< less of planes in one stretch of heights is a detail: a stair's underside

/// A stretch of heights that planes cover, and their area in it.
struct Stretch {
  double low = 0, high = 0;
  double area_m2 = 0;
};

/// What each of the planes covers between two heights, largest plane first.
std::vector<Stretch> covered(const std::vector<SlopedPlane>& planes, double lo, double hi) {
  std::vector<Stretch> stretches;
  for (const SlopedPlane& plane : planes) {
    const auto [low, high] = plane.range();
    const double from = std::max(low, lo);
    const double to = std::min(high, hi);
    if (to - from > kPassesLevel_m)
      stretches.push_back({from, to, plane.area_m2 * (to - from) / (high - low)});
  }
  return stretches;
}

/// Stretches that overlap, or nearly, as one; ascending.
std::vector<Stretch> joined(std::vector<Stretch> stretches, double near) {
  std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
    return std::tie(a.low, a.high, a.area_m2) < std::tie(b.low, b.high, b.area_m2);
  });
  std::vector<Stretch> unions;
  for (const Stretch& next : stretches) {
    if (!unions.empty() && next.low < unions.back().high + near) {
      unions.back().high = std::max(unions.back().high, next.high);
      unions.back().area_m2 += next.area_m2;
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
  const std::vector<Stretch> stretches = covered(planes, lo, hi);
  for (const Stretch& all : joined(stretches, 0.5 * step_m)) {
    const double apart = all.area_m2 < kSmall_m2 ? 2 * step_m : step_m;
    const auto n = std::max(1L, std::lround((all.high - all.low) / apart));
    for (long i = 0; i < n; ++i) {
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
      steps.push_back(clear(all.low + share * (all.high - all.low)));
    }
  }
  for (const Stretch& own : stretches) {
    const auto stands_for_it = [&own](double z) {
      return z > own.low - 0.5 * kClearance_m && z < own.high + 0.5 * kClearance_m;
    };
    if (std::none_of(steps.begin(), steps.end(), stands_for_it)) {
      steps.push_back(clear(0.5 * (own.low + own.high)));
    }
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/steps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "stages/slice/levels.h"
#include "stages/slice/plan_mask.h"

namespace roomcut::slice {
namespace {

constexpr double kPasses_m = 0.08;    ///< a plane that covers less of a gap leaves it alone
constexpr double kClearance_m = 0.1;  ///< of steps from other levels

constexpr double kSmall_m2 =
    10;  ///< less of planes in one stretch of heights is a detail: a stair's underside

Level step_at(double z) {
  return {z, z, z, 0, 0, false, true};
}

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
    if (to - from > kPasses_m) stretches.push_back({from, to, plane.area_m2 * (to - from) / (high - low)});
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

/// Sloped area per height bin between two heights, its sum, and that of all upright area; only over the
/// building and where no level lies above: what looks sloped under a ceiling is edges and furniture.
struct Slopes {
  double lo = 0, hi = 0;  ///< heights between which was looked [m]
  std::map<std::int32_t, double> by_bin;
  double sloped_m2 = 0, upright_m2 = 0;
};

Slopes slopes_between(const std::vector<UprightBlock>& upright, const PlanMask& building,
                      const PlanMask& ceilings, double lo, double hi) {
  Slopes slopes{lo, hi, {}};
  for (const UprightBlock& block : upright) {
    const double z = block.iz * kUprightHeight;
    const double inside = (std::min(z + kUprightHeight, hi) - std::max(z, lo)) / kUprightHeight;
    if (inside <= 0 || !building.contains(block) || ceilings.contains(block)) continue;
    slopes.upright_m2 += inside * block.area_m2;
    if (block.sloped_m2 <= 0) continue;
    slopes.sloped_m2 += inside * block.sloped_m2;
    slopes.by_bin[block.iz] += inside * block.sloped_m2;
  }
  return slopes;
}

double area_between(const VerticalHistogram& histogram, double lo, double hi) {
  double area = 0;
  for (std::size_t i = 0; i < histogram.area_m2.size(); ++i) {
    const double z = histogram.z0 + (static_cast<double>(i) + 0.5) * histogram.bin_m;
    if (lo < z && z < hi) area += histogram.area_m2[i];
  }
  return area;
}

/// The height below which that share of the sloped area lies; inside a bin it is taken to be spread evenly,
/// so that where the bins begin has no say.
double height_of(const Slopes& slopes, double share) {
  const double wanted = share * slopes.sloped_m2;
  double below = 0, z = 0;
  for (const auto& [bin, here] : slopes.by_bin) {
    const double low = std::max(bin * kUprightHeight, slopes.lo);
    const double high = std::min((bin + 1) * kUprightHeight, slopes.hi);
    z = low + std::clamp((wanted - below) / here, 0.0, 1.0) * (high - low);
    below += here;
    if (below >= wanted) break;
  }
  return z;
}

/// Heights between which the bulk of the area lies: without 1 % at both ends, which go on a little, half a
/// bin.
std::pair<double, double> bulk(const Slopes& slopes) {
  const double on = 0.5 * kUprightHeight;
  return {height_of(slopes, 0.01) - on, height_of(slopes, 0.99) + on};
}

/// Steps of the planes between all pairs of neighbouring levels.
std::vector<Level> plane_steps(const std::vector<Level>& levels, const std::vector<SlopedPlane>& planes,
                               double step_m) {
  std::vector<Level> steps;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    for (const double z : steps_between(planes, levels[k].z, levels[k + 1].z, step_m)) {
      steps.push_back(step_at(z));
    }
  }
  return steps;
}

/// Steps of the slopes that no plane explains.
std::vector<Level> unexplained_steps(const std::vector<Level>& levels, const HeightSurvey& survey,
                                     const std::vector<SurfaceCell>& cells, double step_m) {
  constexpr double kSmallest = 15;  // m^2
  constexpr double kShare = 0.2;    // of the upright area: edges and furniture look sloped, too
  constexpr double kEdge = 0.15;    // m; where floors and ceilings meet walls
  constexpr double kSteep = 2;      // times the horizontal area: a gentle vault stays flat
  const PlanMask building = footprint(levels, survey, cells);
  PlanMask ceilings(cells, survey.raster_m);  // of all levels above
  std::vector<Level> steps;
  for (std::size_t k = levels.empty() ? 0 : levels.size() - 1; k-- > 0;) {
    for (const SurfaceCell& cell : cells) {
      if (levels[k + 1].lo <= cell.z && cell.z <= levels[k + 1].hi) ceilings.add(cell);
    }
    const Slopes slopes =
        slopes_between(survey.upright, building, ceilings, levels[k].hi + kEdge, levels[k + 1].lo - kEdge);
    if (slopes.sloped_m2 < std::max(kSmallest, kShare * slopes.upright_m2)) continue;
    const auto [lo, hi] = bulk(slopes);
    if (slopes.sloped_m2 < kSteep * area_between(survey.horizontal, lo, hi)) continue;
    const int n = static_cast<int>(std::lround((hi - lo) / step_m));
    for (int i = 0; i < n; ++i) {
      const double z = lo + (i + 0.5) * (hi - lo) / n;
      if (z < levels[k].hi + 0.5 * step_m || z > levels[k + 1].lo - 0.5 * step_m) continue;
      steps.push_back(step_at(z));
    }
  }
  return steps;
}

}  // namespace

void add_steps(std::vector<Level>& levels, const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
               const std::vector<SlopedPlane>& planes, double step_m) {
  const std::vector<Level> unexplained = unexplained_steps(levels, survey, cells, step_m);
  const std::vector<Level> steps = plane_steps(levels, planes, step_m);
  levels.insert(levels.end(), steps.begin(), steps.end());
  const std::size_t known = levels.size();
  for (const Level& step : unexplained) {
    const bool clear = std::all_of(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(known),
                                   [&](const Level& l) { return std::abs(l.z - step.z) >= 0.5 * step_m; });
    if (clear) levels.push_back(step);
  }
  std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.z < b.z; });
}

}  // namespace roomcut::slice

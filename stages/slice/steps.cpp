// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/steps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "common/slices/plane_steps.h"
#include "stages/slice/levels.h"
#include "stages/slice/plan_mask.h"

namespace roomcut::slice {
namespace {

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
      steps.push_back(step_level(z));
    }
  }
  return steps;
}

}  // namespace

void add_steps(std::vector<Level>& levels, const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
               const std::vector<SlopedPlane>& planes, double step_m) {
  add_steps(levels, planes, unexplained_steps(levels, survey, cells, step_m), step_m);
}

}  // namespace roomcut::slice

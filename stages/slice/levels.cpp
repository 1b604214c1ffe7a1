// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "common/slices/plane_steps.h"
#include "stages/slice/furniture.h"
#include "stages/slice/plan_mask.h"

namespace roomcut::slice {
namespace {

constexpr double kHeadroom = 1.5;  // m; walls on a roof that are lower are a parapet
constexpr double kStep = 0.0025;   // m; grid on which the density is evaluated

/// Density of horizontal area over height [m^2 per m].
struct Density {
  double z0 = 0;
  std::vector<double> value;
  double z(std::size_t i) const { return z0 + static_cast<double>(i) * kStep; }
  std::size_t index(double height) const {
    const double i = std::round((height - z0) / kStep);
    return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(value.size() - 1)));
  }
};

/// Widths in steps of 25 %, so that few different kernels are needed.
int width_class(double width, double base) {
  return static_cast<int>(std::ceil(std::log(width / base) / std::log(1.25) - 1e-9));
}

void convolve(const std::vector<double>& area, double width, std::vector<double>& out) {
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(4 * width / kStep));
  std::vector<double> kernel(static_cast<std::size_t>(2 * reach + 1));
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const double u = static_cast<double>(k) * kStep / width;
    kernel[static_cast<std::size_t>(k + reach)] =
        std::exp(-0.5 * u * u) / (width * std::sqrt(2 * std::numbers::pi));
  }
  const auto n = static_cast<std::ptrdiff_t>(area.size());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    if (area[static_cast<std::size_t>(i)] == 0) continue;
    for (std::ptrdiff_t k = std::max(-reach, -i); k <= reach && i + k < n; ++k) {
      out[static_cast<std::size_t>(i + k)] +=
          area[static_cast<std::size_t>(i)] * kernel[static_cast<std::size_t>(k + reach)];
    }
  }
}

Density density_of(const std::vector<SurfaceCell>& cells, double bandwidth) {
  Density density;
  if (cells.empty()) return density;
  const auto [lowest, highest] =
      std::minmax_element(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  double widest = bandwidth;
  for (const SurfaceCell& cell : cells) widest = std::max(widest, 1.5 * cell.drift_m);
  const double margin = 6 * widest;
  density.z0 = std::floor((lowest->z - margin) / kStep) * kStep;
  const auto size = static_cast<std::size_t>((highest->z + margin - density.z0) / kStep) + 1;
  density.value.assign(size, 0);
  std::map<int, std::vector<double>> classes;
  for (const SurfaceCell& cell : cells) {
    const double width = std::max(bandwidth, 1.5 * cell.drift_m);
    std::vector<double>& area = classes.try_emplace(width_class(width, bandwidth), size, 0.0).first->second;
    area[density.index(cell.z)] += cell.area_m2;
  }
  for (const auto& [width, area] : classes) convolve(area, bandwidth * std::pow(1.25, width), density.value);
  return density;
}

struct Peak {
  std::size_t top = 0, lo = 0, hi = 0;   ///< indices into the density; the basin is [lo, hi]
  double area_m2 = 0, drift_moment = 0;  ///< of the cells in the basin
  double drift() const { return area_m2 > 0 ? drift_moment / area_m2 : 0; }
};

/// Every local maximum with the minima beside it: the fixed points of mean shift and what flows to them.
std::vector<Peak> peaks_of(const std::vector<double>& value) {
  std::vector<Peak> peaks;
  std::size_t valley = 0;
  bool rising = true;
  for (std::size_t i = 1; i < value.size(); ++i) {
    if (rising && value[i] < value[i - 1]) {
      peaks.push_back({i - 1, valley, value.size() - 1, 0, 0});
      rising = false;
    } else if (!rising && value[i] > value[i - 1]) {
      valley = i - 1;
      peaks.back().hi = valley;
      rising = true;
    }
  }
  return peaks;
}

void fill_basins(std::vector<Peak>& peaks, const Density& density, const std::vector<SurfaceCell>& cells) {
  for (const SurfaceCell& cell : cells) {
    const std::size_t i = density.index(cell.z);
    const auto basin = std::lower_bound(peaks.begin(), peaks.end(), i,
                                        [](const Peak& p, std::size_t at) { return p.hi < at; });
    if (basin == peaks.end()) continue;
    basin->area_m2 += cell.area_m2;
    basin->drift_moment += cell.area_m2 * cell.drift_m;
  }
}

/// Joins modes, the most alike pair first; the higher one stays. Two modes are one when the valley between
/// them is hardly lower than the lower one (strips of a vault, ripples of a drifting floor) or when they are
/// nearer than max(2.5 cm, 4 noise) or than both drift.
void join_modes(std::vector<Peak>& peaks, const std::vector<double>& value, double noise_m) {
  constexpr double kShallow = 0.7;
  const double separation = std::max(0.025, 4 * noise_m);
  const auto likeness = [&](const Peak& a, const Peak& b) {  // 1 and more: one mode
    const double apart = static_cast<double>(b.top - a.top) * kStep;
    const double near = std::max(separation, std::min(a.drift(), b.drift())) / apart;
    const double shallow = value[a.hi] / std::min(value[a.top], value[b.top]) / kShallow;
    return std::max(near, shallow);
  };
  while (peaks.size() > 1) {
    std::size_t most = 0;
    for (std::size_t i = 1; i + 1 < peaks.size(); ++i) {
      if (likeness(peaks[i], peaks[i + 1]) > likeness(peaks[most], peaks[most + 1])) most = i;
    }
    Peak& a = peaks[most];
    const Peak& b = peaks[most + 1];
    if (likeness(a, b) < 1) return;
    a = {value[b.top] > value[a.top] ? b.top : a.top, a.lo, b.hi, a.area_m2 + b.area_m2,
         a.drift_moment + b.drift_moment};
    peaks.erase(peaks.begin() + static_cast<std::ptrdiff_t>(most) + 1);
  }
}

/// The end of a peak's band on one side (direction -1 or +1): where the density is low and its gradient has
/// flattened.
std::size_t flat_end(const Density& density, std::size_t top, std::size_t limit, int direction,
                     double reach) {
  const double peak = density.value[top];
  std::size_t i = top;
  while (i != limit && std::abs(density.z(i) - density.z(top)) < reach) {
    const std::size_t next = direction > 0 ? i + 1 : i - 1;
    const double slope = std::abs(density.value[next] - density.value[i]) * (0.01 / kStep);  // per centimetre
    if (density.value[i] < 0.05 * peak && slope < 0.02 * peak) break;
    i = next;
  }
  return i;
}

/// A level that may still turn out to be furniture.
struct Candidate {
  Level level;
  std::vector<SurfaceComponent> surfaces;
  bool floor = false;  ///< walls stand on it
};

Candidate measure(const HeightSurvey& survey, const std::vector<SurfaceCell>& cells, const HeightMode& mode) {
  Candidate candidate;
  Level& level = candidate.level;
  double moment = 0;
  for (const SurfacePatch& patch : survey.patches) {
    if (patch.z < mode.lo || patch.z > mode.hi) continue;
    level.area_m2 += patch.area_m2;
    moment += patch.area_m2 * patch.z;
  }
  level.lo = mode.lo;
  level.hi = mode.hi;
  level.z = level.area_m2 > 0 ? moment / level.area_m2 : mode.z;
  candidate.surfaces = components(cells, mode.lo, mode.hi, survey.raster_m);
  if (!candidate.surfaces.empty()) level.component_m2 = candidate.surfaces.front().area_m2;
  return candidate;
}

/// Walls stand on a floor and end at a ceiling: compares their area in the 30 cm over and under the level.
/// Walls of the rooms beside it, in the same plan cells, may go on past it: half as much again must stand
/// than hangs.
bool is_floor(const Level& level, const HeightSurvey& survey, const std::vector<SurfaceCell>& cells) {
  PlanMask plan(cells, survey.raster_m);
  for (const SurfaceCell& cell : cells) {
    if (level.lo <= cell.z && cell.z <= level.hi) plan.add(cell);
  }
  constexpr double kStandsOn = 1.5;
  double standing = 0, hanging = 0;
  for (const UprightBlock& block : survey.upright) {
    const double above = (block.iz + 0.5) * kUprightHeight - level.z;
    if (std::abs(above) < 0.05 || std::abs(above) > 0.30 || !plan.contains(block)) continue;
    (above > 0 ? standing : hanging) += block.area_m2;
  }
  return standing > kStandsOn * hanging;
}

/// Whether all large surfaces of a candidate are furniture on a larger floor among the others.
bool only_furniture(const Candidate& candidate, const std::vector<Candidate>& all, const CellIndex& index,
                    const HeightSurvey& survey, double smallest) {
  const auto stands_on = [&](const SurfaceComponent& surface) {
    return std::any_of(all.begin(), all.end(), [&](const Candidate& other) {
      return other.floor && other.level.area_m2 > candidate.level.area_m2 &&
             is_furniture(surface, other.level, index, survey);
    });
  };
  return std::all_of(
      candidate.surfaces.begin(), candidate.surfaces.end(),
      [&](const SurfaceComponent& surface) { return surface.area_m2 < smallest || stands_on(surface); });
}

/// How far area goes on beyond a level, given outwards per height bin [m]; 0 when it is too little to count.
/// Inside a bin it is taken to be spread evenly; half a bin more, since the last hundredth goes on a little.
double reach_beyond(const std::map<std::int32_t, double>& beyond, double total, double level_z) {
  double sum = 0;
  for (const auto& [bin, area] : beyond) sum += area;
  if (sum < std::max(1.0, 0.02 * total)) return 0;
  double left = sum;
  for (const auto& [bin, area] : beyond) {
    if (left - area < 0.01 * sum) return (bin + (left - 0.01 * sum) / area + 0.5) * kUprightHeight - level_z;
    left -= area;
  }
  return 0;
}

}  // namespace

std::vector<HeightMode> height_modes(const std::vector<SurfaceCell>& cells, const LevelRules& rules) {
  const Density density = density_of(cells, rules.bandwidth_m);
  std::vector<Peak> peaks = peaks_of(density.value);
  fill_basins(peaks, density, cells);
  if (rules.join_modes) join_modes(peaks, density.value, rules.noise_m);
  std::vector<HeightMode> modes;
  for (const Peak& peak : peaks) {
    if (peak.area_m2 < 0.5) continue;
    const double drift = peak.drift();
    const double reach = std::max({0.04, 6 * rules.noise_m, 2.5 * drift});
    const std::size_t lo = flat_end(density, peak.top, peak.lo, -1, reach);
    const std::size_t hi = flat_end(density, peak.top, peak.hi, +1, reach);
    modes.push_back({density.z(peak.top), density.z(lo), density.z(hi), drift});
  }
  return modes;
}

std::vector<Level> find_levels(const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
                               const LevelRules& rules, std::vector<Level>* rejected) {
  const std::vector<HeightMode> modes = height_modes(cells, rules);
  std::vector<Candidate> candidates(modes.size());
  tbb::parallel_for(std::size_t{0}, modes.size(),
                    [&](std::size_t i) { candidates[i] = measure(survey, cells, modes[i]); });
  const auto size_of = [&](const Level& level) {
    return rules.connected ? level.component_m2 : level.area_m2;
  };
  double largest = 0;
  for (const Candidate& candidate : candidates) largest = std::max(largest, size_of(candidate.level));
  const double smallest = std::max(0.5, std::min(rules.min_component_m2, 0.5 * largest));
  const double speck = rules.connected ? smallest : 0;  // smaller surfaces make no level
  const CellIndex index(cells);
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
    const bool large = size_of(candidates[i].level) >= smallest;
    candidates[i].floor = large && is_floor(candidates[i].level, survey, cells);
  });
  std::vector<Level> levels;
  for (const Candidate& candidate : candidates) {
    if (size_of(candidate.level) >= smallest &&
        !(rules.furniture && only_furniture(candidate, candidates, index, survey, speck))) {
      levels.push_back(candidate.level);
    } else if (rejected != nullptr) {
      rejected->push_back(candidate.level);
    }
  }
  return levels;
}

PlanMask footprint(const std::vector<Level>& levels, const HeightSurvey& survey,
                   const std::vector<SurfaceCell>& cells) {
  PlanMask plan(cells, survey.raster_m);
  for (const SurfaceCell& cell : cells) {
    const bool in_level = std::any_of(levels.begin(), levels.end(), [&](const Level& level) {
      return level.lo <= cell.z && cell.z <= level.hi;
    });
    if (in_level) plan.add(cell);
  }
  return plan;
}

void add_caps(std::vector<Level>& levels, const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
              const std::vector<SlopedPlane>& planes, double reach_m) {
  const auto [bottom, top] = heights_of(planes);
  if (levels.empty()) {
    if (!planes.empty()) levels = {cap_level(bottom - kCloses_m), cap_level(top + kCloses_m)};
    return;
  }
  const PlanMask plan = footprint(levels, survey, cells);
  std::map<std::int32_t, double> above, below;  // below: downwards, of the mirrored heights
  double total = 0;
  for (const UprightBlock& block : survey.upright) {
    total += block.area_m2;
    const double z = (block.iz + 0.5) * kUprightHeight;
    const bool over = z > levels.back().z + reach_m;
    const bool under = z < levels.front().z - reach_m;
    if ((!over && !under) || !plan.contains(block)) continue;
    if (over) above[block.iz] += block.area_m2;
    if (under) below[-block.iz - 1] += block.area_m2;
  }
  const double up = reach_beyond(above, total, levels.back().z);
  const double down = reach_beyond(below, total, -levels.front().z);
  const bool slopes_up = top > levels.back().z + kPassesLevel_m;
  const bool slopes_down = bottom < levels.front().z - kPassesLevel_m;
  const bool roof =
      !slopes_up && levels.size() > 2 && up < kHeadroom && is_floor(levels.back(), survey, cells);
  if (up > 0 && roof) {
    levels.pop_back();
  } else if (up > 0 || slopes_up) {
    const double walls = levels.back().z + up;
    levels.push_back(cap_level(slopes_up ? std::max(walls, top + kCloses_m) : walls));
  }
  if (down > 0 || slopes_down) {
    const double walls = levels.front().z - down;
    levels.insert(levels.begin(), cap_level(slopes_down ? std::min(walls, bottom - kCloses_m) : walls));
  }
}

}  // namespace roomcut::slice

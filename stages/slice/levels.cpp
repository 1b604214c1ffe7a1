// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/levels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace roomcut {
namespace {

constexpr double kStep = 0.0025;  // m; grid on which the density is evaluated

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
  std::size_t top, lo, hi;  ///< indices into the density; the basin is [lo, hi]
};

/// Every local maximum with the minima beside it: the fixed points of mean shift and what flows to them.
std::vector<Peak> peaks_of(const std::vector<double>& value) {
  std::vector<Peak> peaks;
  std::size_t valley = 0;
  bool rising = true;
  for (std::size_t i = 1; i < value.size(); ++i) {
    if (rising && value[i] < value[i - 1]) {
      peaks.push_back({i - 1, valley, value.size() - 1});
      rising = false;
    } else if (!rising && value[i] > value[i - 1]) {
      valley = i - 1;
      peaks.back().hi = valley;
      rising = true;
    }
  }
  return peaks;
}

/// Joins modes that are nearer than `separation`, the closest pair first; the higher one stays.
void join_near(std::vector<Peak>& peaks, const std::vector<double>& value, double separation) {
  const auto apart = static_cast<std::size_t>(separation / kStep);
  while (peaks.size() > 1) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i + 1 < peaks.size(); ++i) {
      if (peaks[i + 1].top - peaks[i].top < peaks[nearest + 1].top - peaks[nearest].top) nearest = i;
    }
    Peak& a = peaks[nearest];
    const Peak& b = peaks[nearest + 1];
    if (b.top - a.top >= apart) return;
    a = {value[b.top] > value[a.top] ? b.top : a.top, a.lo, b.hi};
    peaks.erase(peaks.begin() + static_cast<std::ptrdiff_t>(nearest) + 1);
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

Level measure(const HeightSurvey& survey, const std::vector<SurfaceCell>& cells, double lo, double hi,
              double raster_m) {
  Level level;
  double area = 0, moment = 0;
  for (const SurfacePatch& patch : survey.patches) {
    if (patch.z < lo || patch.z > hi) continue;
    area += patch.area_m2;
    moment += patch.area_m2 * patch.z;
  }
  level.lo = lo;
  level.hi = hi;
  level.area_m2 = area;
  level.z = area > 0 ? moment / area : 0.5 * (lo + hi);
  level.component_m2 = largest_component_m2(cells, lo, hi, raster_m);
  return level;
}

}  // namespace

std::vector<HeightMode> height_modes(const std::vector<SurfaceCell>& cells, const LevelRules& rules) {
  const Density density = density_of(cells, rules.bandwidth_m);
  std::vector<Peak> peaks = peaks_of(density.value);
  join_near(peaks, density.value, std::max(0.025, 4 * rules.noise_m));
  std::vector<HeightMode> modes;
  for (const Peak& peak : peaks) {
    double sum = 0, drift = 0;
    for (const SurfaceCell& cell : cells) {
      const std::size_t i = density.index(cell.z);
      if (i < peak.lo || i > peak.hi) continue;
      sum += cell.area_m2;
      drift += cell.area_m2 * cell.drift_m;
    }
    if (sum < 0.5) continue;
    drift /= sum;
    const double reach = std::max({0.04, 6 * rules.noise_m, 2.5 * drift});
    const std::size_t lo = flat_end(density, peak.top, peak.lo, -1, reach);
    const std::size_t hi = flat_end(density, peak.top, peak.hi, +1, reach);
    modes.push_back({density.z(peak.top), density.z(lo), density.z(hi), drift});
  }
  return modes;
}

std::vector<Level> find_levels(const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
                               const LevelRules& rules, std::vector<Level>* rejected) {
  std::vector<Level> candidates;
  double largest = 0;
  for (const HeightMode& mode : height_modes(cells, rules)) {
    candidates.push_back(measure(survey, cells, mode.lo, mode.hi, rules.raster_m));
    largest = std::max(largest, candidates.back().component_m2);
  }
  const double smallest = std::max(0.5, std::min(rules.min_component_m2, 0.5 * largest));
  std::vector<Level> levels;
  for (const Level& level : candidates) {
    if (level.component_m2 >= smallest) {
      levels.push_back(level);
    } else if (rejected != nullptr) {
      rejected->push_back(level);
    }
  }
  return levels;
}

void add_caps(std::vector<Level>& levels, const VerticalHistogram& upright, double reach_m) {
  if (levels.empty()) return;
  double total = 0;
  for (const double area : upright.area_m2) total += area;
  const double stray = std::min(1.0, 0.01 * total);
  const auto end = [&](auto first, auto last) {
    double beyond = 0;
    for (auto it = first; it != last; ++it) {
      beyond += *it;
      if (beyond > stray) return static_cast<double>(it - first);
    }
    return static_cast<double>(last - first);
  };
  const double bottom = upright.z0 + upright.bin_m * end(upright.area_m2.begin(), upright.area_m2.end());
  const double top = upright.z0 + upright.bin_m * (static_cast<double>(upright.area_m2.size()) -
                                                   end(upright.area_m2.rbegin(), upright.area_m2.rend()));
  if (bottom >= top) return;
  if (bottom < levels.front().z - reach_m)
    levels.insert(levels.begin(), {bottom, bottom, bottom, 0, 0, true});
  if (top > levels.back().z + reach_m) levels.push_back({top, top, top, 0, 0, true});
}

}  // namespace roomcut

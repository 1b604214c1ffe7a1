// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/tolerances.h"

#include <algorithm>
#include <cmath>

#include "common/geometry/preferred_number.h"

namespace roomcut::weigh_faces {

Tolerances resolve_tolerances(const WeighFacesParams& params, const CloudHeader& cloud) {
  const double noise = std::clamp(cloud.noise_m, 0.001, 0.05);
  const double spacing = cloud.density > 0 ? 1.0 / std::sqrt(cloud.density) : 0.05;
  Tolerances t{};
  // A bin of a covered surface should hold about 1.5 points or more: the correction for empty bins stays
  // small.
  const double tau = params.tau_m.value_or(std::clamp(preferred_number(0.6 * spacing), 0.04, 0.15));
  t.bin = 2 * tau;
  t.wall_reach = params.wall_reach_m.value_or(std::max(0.04, std::min(3 * noise, 0.055)));
  t.wall_tight = std::max(0.012, 2.5 * noise);
  t.wall_alone = std::max(0.12, 2.5 * t.wall_reach);
  t.azimuth = params.azimuth_rad;
  t.level_reach = params.level_reach_m.value_or(std::max(0.06, 6 * noise));
  t.level_tight = std::max(0.012, 2.5 * noise);
  t.slope_reach = 0.2;
  t.beside_low = std::max(0.03, 4 * noise);
  t.beside_high = t.beside_low + 0.06;
  t.over_low = std::max(0.04, 4 * noise);
  t.over_high = t.over_low + 0.08;
  t.core_margin = std::max(0.015, 3 * noise);
  t.top_share = params.top_share;
  t.edge_bins = params.wall_bins == "edge";
  t.correct_density = params.correct_density;
  t.slopes = params.slopes;
  return t;
}

}  // namespace roomcut::weigh_faces

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

namespace roomcut::slice {

/// Parameters of `slice`; an empty optional is derived from noise and density (slice.h: SliceChoices says
/// what and why).
struct SliceParams {
  std::optional<double> bandwidth_m;       ///< of the mean shift over heights [m]
  std::optional<double> raster_m;          ///< edge of the plan raster in which surfaces are connected [m]
  std::optional<double> min_component_m2;  ///< smallest connected surface that makes a level [m^2]
  std::optional<double> tau_m;             ///< edge of the occupancy cells [m]
  double cap_reach_m = 0.2;                ///< walls that go on farther past the last level get a cap [m]
  double step_m = 0.3;                     ///< distance of the levels that stand for a slope; 0 = none [m]
  double tall_slice_m = 1.5;               ///< higher wall slices count evidence in their top part only [m]
  double evidence_share = 0.25;            ///< that top part, as a share of the slice's height
};

}  // namespace roomcut::slice

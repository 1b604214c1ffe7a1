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
  bool by_area = true;           ///< horizontal points weigh the area for which they stand, else all the same
  bool drift = true;             ///< drifting surfaces get a wider bandwidth
  bool join_modes = true;        ///< modes that are nearly one become one level
  bool connected = true;         ///< min_component_m2 must be one connected surface, else the sum of the band
  bool furniture = true;         ///< surfaces of furniture are told apart and are no levels
  bool upright_only = true;      ///< horizontal and sloped points do not count in wall slices
  double cap_reach_m = 0.2;      ///< walls that go on farther past the last level get a cap [m]
  double step_m = 0.3;           ///< distance of the levels that stand for a slope; 0 = none [m]
  double tall_slice_m = 1.5;     ///< higher wall slices count evidence in their top part only [m]
  double evidence_share = 0.25;  ///< that top part, as a share of the slice's height
};

}  // namespace roomcut::slice

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>
#include <string>

namespace roomcut::weigh_faces {

/// Parameters of weigh_faces. Empty = auto: derived from the cloud's noise and density (tolerances.h).
struct WeighFacesParams {
  std::optional<double> tau_m;          ///< half the edge of a coverage bin [m]
  std::optional<double> wall_reach_m;   ///< a point belongs to a wall line up to this distance [m]
  std::optional<double> level_reach_m;  ///< a horizontal point belongs to a level up to this distance [m]
  double azimuth_rad =
      17.0 * std::numbers::pi / 180.0;  ///< largest angle between a point's normal and a line's
  double top_share =
      0.25;  ///< a wall also counts by its top share alone, free of furniture; 0 = whole face only
  std::string wall_bins = "face";  ///< "face": on the upright face; "edge": along its edge in plan
  bool correct_density = true;     ///< occupied bins stand for those that a thin sample missed
  bool seen_through = true;        ///< walls seen through another one's windows lose coverage
  bool continue_walls = true;      ///< small wall faces take the coverage of the one above or below
  bool slopes = true;              ///< sloped points cover levels
  bool sides = true;               ///< which side is empty is found out; else either, half and half
};

}  // namespace roomcut::weigh_faces

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>
#include <string>

#include "common/params/params.h"

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

/// The block `weigh_faces` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(WeighFacesParams& p) {
  return {
      auto_number("tau_m", p.tau_m, "m", 0.01, 0.5, "Half the edge of the bins in which coverage is counted.",
                  "0.6 x point spacing (a preferred number), 4 ... 15 cm"),
      auto_number("wall_reach_m", p.wall_reach_m, "m", 0.005, 0.5,
                  "Largest distance of a wall's points from its line.", "3 x noise, 4 ... 5.5 cm"),
      auto_number("level_reach_m", p.level_reach_m, "m", 0.005, 0.5,
                  "Largest distance of a floor's points from its level.",
                  "max(6 cm, 6 x noise), noise up to 5 cm"),
      angle("azimuth_deg", p.azimuth_rad, 1.0, 45.0,
            "Largest angle between a wall point's normal and its line's."),
      number("top_share", p.top_share, "1", 0.0, 1.0,
             "A wall also counts by this top share of its height alone, which furniture leaves free; 0 = "
             "never."),
      choice(
          "wall_bins", p.wall_bins, {"face", "edge"},
          "face: bins lie on a wall's face; edge: the paper's, along its edge in plan, whatever the height."),
      boolean("correct_density", p.correct_density,
              "Occupied bins also stand for those that a thin sample missed; false: bins are counted."),
      boolean("seen_through", p.seen_through,
              "Walls that were seen through the openings of another one lose coverage."),
      boolean("continue_walls", p.continue_walls,
              "Wall faces too small to be hit take the coverage of the face above or below."),
      boolean("slopes", p.slopes, "Points of sloped surfaces cover levels like ceilings."),
      boolean("sides", p.sides, "Find out which side of each face is empty; false: both alike, a half each."),
  };
}

}  // namespace roomcut::weigh_faces

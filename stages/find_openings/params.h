// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params/params.h"
#include "stages/find_openings/find_openings.h"

namespace roomcut::find_openings {

/// The block `find_openings` of pipeline.yaml, bound to `params`.
inline ParameterTable find_openings_parameters(FindOpeningsParams& p) {
  return {
      boolean("enabled", p.enabled, "Find doors and passages; false leaves every wall closed."),
      number("min_width_m", p.min_width_m, "m", 0.3, 10, "Narrowest opening, from jamb to jamb."),
      number("max_width_m", p.max_width_m, "m", 0.5, 20, "Widest opening."),
      number("min_height_m", p.min_height_m, "m", 0.5, 10, "Lowest opening, from the floor to its head."),
      number("max_thickness_m", p.max_thickness_m, "m", 0.05, 3, "Thicker walls are not looked through."),
      auto_number("margin_m", p.margin_m, "m", 0.002, 0.1,
                  "Points this near a face of a wall lie on it, not inside the wall.",
                  "max(1.5 cm, 3 x noise), at most a third of the wall"),
  };
}

}  // namespace roomcut::find_openings

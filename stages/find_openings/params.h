// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/params/params.h"

namespace roomcut::find_openings {

struct FindOpeningsParams {
  bool enabled = true;
  double min_width_m = 0.5;
  double max_width_m = 6.0;
  double min_height_m = 1.6;
  double max_thickness_m = 0.6;
  std::optional<double> margin_m;  ///< auto: max(1.5 cm, 3 noise)
};

/// The block `find_openings` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(FindOpeningsParams& p) {
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

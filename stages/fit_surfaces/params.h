// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/params/params.h"

namespace roomcut::fit_surfaces {

struct FitSurfacesParams {
  bool enabled = true;
  std::optional<double> reach_m;  ///< auto: max(15 cm, 6 noise)
  double patch_m = 0.5;
  bool tilt = true;
  bool split = true;
};

/// The block `fit_surfaces` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(FitSurfacesParams& p) {
  return {
      boolean("enabled", p.enabled,
              "Give every floor and ceiling its own height; false leaves all at their levels, as the paper "
              "does."),
      auto_number("reach_m", p.reach_m, "m", 0.005, 0.5,
                  "Largest distance of a floor's or ceiling's points from its level or sloped plane.",
                  "max(15 cm, 6 x noise)"),
      number("patch_m", p.patch_m, "m", 0.1, 5, "Edge of the patches of floor that give one observation."),
      boolean("tilt", p.tilt,
              "Floors and ceilings follow a tilted plane where their points prove it; false: all are level."),
      boolean("split", p.split,
              "A floor or ceiling that lies at two heights, each over whole faces of the plan, becomes two."),
  };
}

}  // namespace roomcut::fit_surfaces

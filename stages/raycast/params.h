// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/params/params.h"

namespace roomcut::raycast {

struct RaycastParams {
  int rays = 64;                      ///< rays per cell: half of them level, half uniform on the sphere
  std::string evidence = "combined";  ///< "combined": all measures; "parity": the paper's kappa alone
  double surface_depth_m = 0.1;       ///< weight of a cell's own covered faces: volume per square metre [m]
};

/// The block `raycast` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(RaycastParams& p) {
  return {
      integer("rays", p.rays, "1", 2, 4096, "Rays per cell, half of them level, half uniform on the sphere."),
      choice("evidence", p.evidence, {"combined", "parity"},
             "combined: all measures; parity: the paper's share of odd rays alone."),
      number("surface_depth_m", p.surface_depth_m, "m", 0.0, 10.0,
             "Volume per square metre with which a cell's own covered faces say on which side it is."),
  };
}

}  // namespace roomcut::raycast

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/params/params.h"

namespace roomcut::raycast {

struct RaycastParams {
  int rays = 64;                      ///< rays per cell
  std::string evidence = "combined";  ///< "combined": all measures; "parity": the paper's kappa alone
  std::string origins = "spread";     ///< of the rays: "spread" over the cell; "centre": the paper's
  bool level_rays = true;             ///< half of the rays are level; else all uniform on the sphere
  bool implied_faces = true;          ///< unseen other sides of walls and slabs are not charged
  double surface_depth_m = 0.1;       ///< weight of a cell's own covered faces: volume per square metre [m]
};

/// The block `raycast` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(RaycastParams& p) {
  return {
      integer("rays", p.rays, "1", 2, 4096, "Rays per cell."),
      choice("evidence", p.evidence, {"combined", "parity"},
             "combined: all measures; parity: the paper's share of odd rays alone."),
      choice("origins", p.origins, {"spread", "centre"},
             "Where a cell's rays begin: spread over it, or at its centre as the paper's."),
      boolean("level_rays", p.level_rays,
              "Half of the rays are level; false: all are uniform on the sphere."),
      boolean("implied_faces", p.implied_faces,
              "The unseen other side of a wall or slab costs graphcut nothing; never with parity."),
      number("surface_depth_m", p.surface_depth_m, "m", 0.0, 10.0,
             "Volume per square metre with which a cell's own covered faces say on which side it is."),
  };
}

}  // namespace roomcut::raycast

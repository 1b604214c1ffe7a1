// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace roomcut::raycast {

/// Parameters of raycast.
struct RaycastParams {
  int rays = 64;                      ///< rays per cell
  std::string evidence = "combined";  ///< "combined": all measures; "parity": the paper's kappa alone
  std::string origins = "spread";     ///< of the rays: "spread" over the cell; "centre": the paper's
  bool level_rays = true;             ///< half of the rays are level; else all uniform on the sphere
  bool implied_faces = true;          ///< unseen other sides of walls and slabs are not charged
  double surface_depth_m = 0.1;       ///< weight of a cell's own covered faces: volume per square metre [m]
};

}  // namespace roomcut::raycast

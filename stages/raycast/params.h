// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace roomcut::raycast {

/// Parameters of raycast.
struct RaycastParams {
  int rays = 64;                      ///< rays per cell: half of them level, half uniform on the sphere
  std::string evidence = "combined";  ///< "combined": all measures; "parity": the paper's kappa alone
  double surface_depth_m = 0.1;       ///< weight of a cell's own covered faces: volume per square metre [m]
};

}  // namespace roomcut::raycast

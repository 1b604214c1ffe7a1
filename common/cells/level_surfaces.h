// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut {

/// The true plane of a connected floor or ceiling, measured after the cut.
struct LevelSurface {
  Vec2 gradient{0, 0};      ///< rise per metre; (0, 0) = level
  double c = 0;             ///< height over the local origin: the surface is gradient · p + c [m]
  double sigma_m = 0;       ///< standard deviation of its height at its middle [m]
  double area_m2 = 0;       ///< of the plan
  std::int64_t points = 0;  ///< that it was fitted to; 0 = it follows another one
  std::int32_t plane = -1;  ///< the sloped plane of the complex that it is a part of; -1 = none

  double height(const Vec2& p) const { return gradient.dot(p) + c; }
};

/// What stands at the level faces of a labelling's surface in place of the levels: every floor and ceiling at
/// its own height, sloped ones as planes. Belongs to one complex and one labelling.
struct LevelSurfaces {
  std::vector<LevelSurface> surfaces;
  std::vector<std::int32_t> of_face;  ///< per level face an index into surfaces; -1 = it lies at its level
};

}  // namespace roomcut

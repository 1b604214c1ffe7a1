// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/line2.h"

namespace roomcut {

/// The smallest rotation that brings the unit vector `level` (of a Frame: up, as the floors say) onto z. It
/// turns the scan's coordinates, once the origin is subtracted, into local ones; its transpose turns them
/// back. level.z > −1.
inline Eigen::Matrix3d level_turn(const double (&level)[3]) {
  const double x = level[0];
  const double y = level[1];
  const double f = 1 / (1 + level[2]);
  Eigen::Matrix3d turn;
  turn << 1 - f * x * x, -f * x * y, -x, -f * x * y, 1 - f * y * y, -y, x, y, level[2];
  return turn;
}

}  // namespace roomcut

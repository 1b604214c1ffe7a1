// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bitset>
#include <numbers>

#include "common/cloud/cloud.h"

namespace roomcut {

/// How far the normal of a wall's points may be turned from the normal of the line they lie on [rad]: within
/// it lie nearly all azimuths of a noisy wall, and no wall that meets it at a corner.
inline constexpr double kAzimuthFits_rad = 17.0 * std::numbers::pi / 180.0;

/// One bit per azimuth step of CloudTile: whether a wall's point of that azimuth may lie on a line.
using AzimuthSet = std::bitset<kAzimuthSteps>;

/// Those that differ by at most `limit_rad` from the line's normal angle theta [rad].
inline AzimuthSet azimuths_on(double theta, double limit_rad) {
  AzimuthSet set;
  for (std::size_t step = 0; step < set.size(); ++step) {
    set[step] = angle_between(azimuth_of(static_cast<std::uint8_t>(step)), theta) <= limit_rad;
  }
  return set;
}

}  // namespace roomcut

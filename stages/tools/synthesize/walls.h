// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// A straight piece of wall between two rooms: its middle line where both rooms face it.
struct Wall {
  int room_a = 0, room_b = 0;
  Vec2 a{0, 0}, b{0, 0};  ///< [m]
  double thickness = 0, z0 = 0, z1 = 0;
};

/// All walls up to 0.6 m thick, 0.2 m long or more, parallel within 1 degree, by (room_a, room_b).
std::vector<Wall> find_walls(const Scene& scene);

}  // namespace roomcut::synthesize

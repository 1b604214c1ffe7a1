// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "common/wall_lines/wall_line.h"

namespace roomcut::partition {

/// Moves applied to a whole set of lines, for metamorphic tests.
struct Motion {
  double angle = 0;
  Vec2 shift{0, 0};
  Vec2 operator()(const Vec2& p) const;
};

/// `count` lines in a 20 x 15 m plan: half along x, 2 of 5 along y, the rest at any angle; with `nasty`, some
/// repeat another line exactly, 1e-9 m or 1e-6 m beside it or turned by 1e-7 rad, or pass through one common
/// point.
WallLines random_lines(std::uint64_t seed, int count, bool nasty, const Motion& motion = {});

}  // namespace roomcut::partition

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "common/wall_lines/wall_line.h"

namespace roomcut {

/// The arc of which a wall line is a chord: a curved wall, a part of a circle in plan.
struct WallArc {
  std::string id;  ///< "a0001"; the same of all chords of one arc
  Vec2 centre{0, 0};
  double radius_m = 0;
};

/// The names of the properties that say it, among WallLine::extra_json. The centre is in the scan's
/// coordinates.
inline constexpr const char* kArcProperties[] = {"arc_id", "arc_x", "arc_y", "arc_radius_m"};

/// The arc of a line, in local coordinates of `frame`; nothing when it has none, or says it incompletely.
/// Numbers as text count, as in all of an edit.
std::optional<WallArc> arc_of(const WallLine& line, const Frame& frame);

/// Writes the arc into the line's properties, rounded to 1e-6 m; without one takes it out of them.
void set_arc(WallLine& line, const std::optional<WallArc>& arc, const Frame& frame);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "common/geometry/sloped_plane.h"
#include "common/slices/slices.h"

// Levels that stand for sloped planes, as stairs would. All deterministic; levels are ascending.
namespace roomcut {

inline constexpr double kPassesLevel_m = 0.08;  ///< a plane that goes on less far beyond a level ends there
inline constexpr double kCloses_m =
    0.3;  ///< a cap so far beyond the last of a slope, which its last step needs

/// A level that is no surface: closes the building, or stands for a slope.
Level cap_level(double z);
Level step_level(double z);

/// Lowest and highest height of all planes over their outlines; (+inf, -inf) when there are none.
std::pair<double, double> heights_of(const std::vector<SlopedPlane>& planes);

/// Adds steps: between two neighbouring levels that planes pass by more than 8 cm, what they cover is cut
/// into equal steps of about `step_m` (twice that where under 10 m^2 slopes) with a level at the middle of
/// each; a plane that meets none of these gets one at the middle of its own heights there. None lies nearer
/// than 10 cm to another level. Then those of `others` that lie half a step or more from all of them.
void add_steps(std::vector<Level>& levels, const std::vector<SlopedPlane>& planes,
               const std::vector<Level>& others, double step_m);

/// The levels of a building, made by add_steps() with planes `before`, as they are with planes `after`: steps
/// anew, and a cap where a plane now goes on beyond the last level. Equal planes give equal levels.
std::vector<Level> levels_with_planes(const std::vector<Level>& levels,
                                      const std::vector<SlopedPlane>& before,
                                      const std::vector<SlopedPlane>& after, double step_m);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// Chords of an arc leave it by at most this [m]: below what any scanner tells.
inline constexpr double kSagitta = 2e-4;

/// How many chords an arc of an angle [rad] takes at kSagitta.
int fine_chords(double radius, double angle);
/// The same of the arc from a through b to c. Throws std::invalid_argument when they are collinear.
int smooth_chords(const Vec2& a, const Vec2& b, const Vec2& c);

/// A round column; its polygon has the circle's area, so that its volume is the cylinder's.
SceneColumn round_column(const Vec2& centre, double diameter);
SceneColumn rectangular_column(const Vec2& centre, double size_x, double size_y, double rotation);

}  // namespace roomcut::synthesize

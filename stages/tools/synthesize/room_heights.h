// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// Height of the room's floor over p, columns apart [m].
double floor_at(const SceneRoom& room, const Vec2& p);
/// Height of its ceiling [m]; not above the floor where a roof has come down to it.
double ceiling_at(const SceneRoom& room, const Vec2& p);
/// The slope that is the floor (or ceiling) over p: an index into room.slopes, or -1 = the level one.
int surface_at(const SceneRoom& room, const Vec2& p, bool ceiling);

/// Where two of the room's floors and ceilings meet, level ones included: pieces of lines inside its polygon.
std::vector<std::array<Vec2, 2>> creases(const SceneRoom& room);

/// Lowers the room's ceiling to the highest place of its slopes, and raises its floor to their lowest, where
/// slopes cover all of the room; says so in level_floor and level_ceiling.
void settle_heights(SceneRoom& room);

/// Kinds of roof over a rectangle.
enum class RoofKind { kMonopitch, kGable, kHip };

/// The ceilings under a roof of one pitch over the smallest rectangle around `footprint` with a side along
/// the azimuth. It falls towards the azimuth, a gable also away from it, a hip to all four sides; at the
/// rectangle's sides it falls to, it is at height `eaves`.
std::vector<SceneSlope> roof(RoofKind kind, const Polygon2& footprint, double pitch, double azimuth,
                             double eaves);

/// The plane through `at` that falls with a pitch towards an azimuth, both in radians.
SceneSlope sloped(bool ceiling, const Vec3& at, double pitch, double azimuth);

}  // namespace roomcut::synthesize

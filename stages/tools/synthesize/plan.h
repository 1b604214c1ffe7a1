// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// Twice the signed area; positive when counter-clockwise [m^2].
double doubled_area(const Polygon2& polygon);
/// Area-weighted mean of the polygon [m].
Vec2 polygon_centroid(const Polygon2& polygon);
/// Even-odd test; points on the border go either way.
bool contains(const Polygon2& polygon, const Vec2& p);
/// Distance from p to the polygon's border [m].
double border_distance(const Polygon2& polygon, const Vec2& p);
/// Whether two borders cross properly.
bool borders_cross(const Polygon2& a, const Polygon2& b);
/// Whether the border touches or crosses itself.
bool self_intersects(const Polygon2& polygon);
/// A point well inside: the best of a coarse raster, refined (pole of inaccessibility).
Vec2 innermost_point(const Polygon2& polygon);

/// The side (index of its first corner) that is nearest to p.
std::size_t nearest_side(const Polygon2& polygon, const Vec2& p);

/// Moves every side inwards by its own distance and joins neighbours where they meet (mitre).
/// `distance` has one entry per side; collinear neighbours must have the same. Throws std::invalid_argument
/// when they do not or when the room vanishes.
Polygon2 inset(const Polygon2& outline, const std::vector<double>& distance);

/// The corners of a circular arc from a through b to c as `segments` chords, without a. Throws
/// std::invalid_argument when the three are collinear.
std::vector<Vec2> arc_points(const Vec2& a, const Vec2& b, const Vec2& c, int segments);

}  // namespace roomcut::synthesize

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// A convex piece of a floor plan between the middles of its walls.
struct Lot {
  Polygon2 corners;          ///< counter-clockwise [m]
  std::vector<double> wall;  ///< per side: thickness of its wall; 0 = outer wall [m]
};

/// The parts left and right of the line through `through` along `direction`, divided by a wall. A part may be
/// empty.
std::pair<Lot, Lot> split_lot(const Lot& lot, const Vec2& through, const Vec2& direction, double wall);

/// Extent of the lot along a direction of unit length [m].
double extent(const Lot& lot, const Vec2& direction);

/// Whether the lot can be a room: at least 2.2 m across, no corner sharper than 35 degrees, no side under 0.8
/// m unless it is a chord of an arc.
bool is_room(const Lot& lot);

/// Where two lots share a wall.
struct Contact {
  std::size_t a, b;
  Vec2 from, to;  ///< ends of the common part [m]
};
/// All contacts of at least `shortest` metres, by (a, b).
std::vector<Contact> find_contacts(const std::vector<Lot>& lots, double shortest);

/// The points turned about the origin [rad].
std::vector<Vec2> turned(const std::vector<Vec2>& points, double angle);

}  // namespace roomcut::synthesize

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// An empty upright prism, that of a room cut by its slopes. The truth is the union of all prisms, without
/// the solids.
struct Prism {
  Polygon2 polygon;
  double z0 = 0, z1 = 0;         ///< [m], multiples of 1 µm
  int room_a = -1, room_b = -1;  ///< a room: itself and -1; a doorway, shaft or niche: the rooms it joins
  bool is_room() const { return room_b < 0; }
};

/// A rectangle in a wall, seen from its room: `right` along the wall, `outwards` into the wall.
struct WallOpening {
  Vec2 centre{0, 0};  ///< on the room's wall plane
  Vec2 right{1, 0}, outwards{0, 1};
  double width = 0, z0 = 0, z1 = 0;
  double depth = 0;              ///< into the wall [m]
  int room_a = -1, room_b = -1;  ///< room_b: doors only
};

/// What is solid in one room from floor to ceiling: a column or pilaster.
struct Solid {
  Polygon2 polygon;
  int room = -1;
};

/// A niche (or, solid, a pilaster) as it was placed.
struct PlacedNiche {
  Polygon2 polygon;  ///< from the room's wall plane on
  double z0 = 0, z1 = 0;
  double width = 0, depth = 0;
  int room = -1;
  bool solid = false;
};

/// A scene with everything placed: what the truth and the scan are made from.
struct Building {
  std::vector<Prism> prisms;
  std::vector<Solid> solids;
  std::vector<PlacedNiche> niches;
  std::vector<WallOpening> doors, windows;
  std::vector<SceneFurniture> furniture;
  std::vector<Vec3> stations;     ///< scanner positions
  std::vector<int> station_room;  ///< the room each stands in; -1 = none
  Vec3 lo{0, 0, 0}, hi{0, 0, 0};  ///< bounding box of the prisms
};

/// Places doors, windows, furniture and stations. Heights are rounded to 1 µm.
/// Throws StageError(kSceneInvalid) with all problems: a door that does not fit its wall, …
Building place(const Scene& scene);

/// Adds random boxes to every room: along walls and free, clear of doors and of each other.
void furnish(const Scene& scene, Building& building);

/// Whether p (with `margin` around the box in plan) lies in the box's plan.
bool in_plan(const SceneFurniture& box, const Vec2& p, double margin);

}  // namespace roomcut::synthesize

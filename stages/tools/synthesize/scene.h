// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut::synthesize {

/// The hint of a problem that has no closer one.
inline constexpr const char* kSceneRemedy =
    "correct the scene: schemas/scene.md says what each member may be";

using Polygon2 = std::vector<Vec2>;  ///< corners, counter-clockwise, not closed [m]

/// A part of a room's ceiling or floor at its own height or slope: z = gradient · p + c. A ceiling is the
/// lowest, a floor the highest of what lies over each other.
struct SceneSlope {
  bool ceiling = true;
  Vec2 gradient{0, 0};  ///< rise per metre, uphill
  double c = 0;         ///< [m]
  Polygon2 polygon;     ///< where it is; empty = in the whole room
  double height(const Vec2& p) const { return gradient.dot(p) + c; }
};

/// A pier inside a room, solid from floor to ceiling.
struct SceneColumn {
  Polygon2 polygon;
  Vec2 centre{0, 0};
  double size_x = 0, size_y = 0;  ///< before the rotation; diameter of a round one [m]
  bool round = false;
};

/// A recess of a room's wall, or (depth < 0) a pilaster before it.
struct SceneNiche {
  Vec2 at{0, 0};  ///< near its middle; projected on the nearest wall of the room [m]
  double width = 0.6, depth = 0.1;
  double sill = 0;    ///< above the room's floor [m]
  double height = 0;  ///< 0 = up to the ceiling [m]
};

/// A circular part of a room's outline, counter-clockwise from one corner of the polygon to another.
struct SceneArc {
  Vec2 centre{0, 0};
  double radius = 0;
  Vec2 from{0, 0}, to{0, 0};  ///< ends, equal for a whole circle
  bool bulges = true;         ///< the room lies on the centre's side
};

/// A room: the empty volume over a polygon from its floor to its ceiling, without its columns. Walls are what
/// lies between rooms.
struct SceneRoom {
  std::string name;  ///< unique in the scene
  int storey = 0;    ///< index into Scene::storeys
  Polygon2 polygon;
  double floor = 0, ceiling = 0;  ///< lowest and highest [m]
  bool scanned = true;            ///< tripod sampling: whether a scanner may stand here
  std::vector<SceneSlope> slopes;
  bool level_floor = true, level_ceiling = true;  ///< false: slopes are everywhere above it, or below
  std::vector<SceneColumn> columns;
  std::vector<SceneNiche> niches;
  std::vector<SceneArc> arcs;
};

/// An open doorway: an empty box through the wall between two rooms.
struct SceneDoor {
  int room_a = 0, room_b = 0;
  Vec2 at{0, 0};  ///< near the middle of the doorway; projected on the nearest wall of room_a [m]
  double width = 0.9, height = 2.1;
  double sill = 0;  ///< height of the threshold above the higher of the two floors [m]
};

/// A window: no points come from its pane; its reveal lies in the wall and is not part of the truth.
struct SceneWindow {
  int room = 0;
  Vec2 at{0, 0};  ///< near the middle of the window; projected on the nearest wall of the room [m]
  double width = 1.2, height = 1.2;
  double sill = 0.9;   ///< above the room's floor [m]
  double depth = 0.1;  ///< of the reveal; 0 = the pane is flush with the wall [m]
};

/// A box that gives points and hides what is behind it, but is not permanent structure.
struct SceneFurniture {
  Vec2 centre{0, 0};
  double size_x = 0, size_y = 0;  ///< before the rotation [m]
  double z0 = 0, z1 = 0;
  double rotation = 0;  ///< counter-clockwise [rad]
};

/// A vertical opening through a slab: an empty prism from the lower room's ceiling to the upper room's floor.
struct SceneShaft {
  int lower = 0, upper = 0;
  Polygon2 polygon;
};

enum class SamplingKind { kUniform, kTripod };

struct Sampling {
  SamplingKind kind = SamplingKind::kUniform;
  std::uint64_t points = 1000000;  ///< exact when uniform, met within about 1 % by a tripod
  bool shuffled = false;           ///< uniform only: points in random order instead of surface by surface
  std::vector<Vec3> stations;      ///< scanner positions; empty = one or more per room
  double station_height = 1.6;     ///< above the floor, for stations that are not given [m]
  double blind_cone = 0.5236;      ///< half angle of the cone below the scanner that it cannot see [rad]
  double max_range = 60;           ///< [m]
};

/// Errors of scans by phones and depth cameras, which no point has of its own.
struct HandheldErrors {
  double warp_m = 0;         ///< standard deviation of the surfaces' smooth warp, per coordinate
  double correlation_m = 1;  ///< over which distance it varies
  double rounding_m = 0;     ///< radius of the rounded corners of rooms
  double drift_m = 0;        ///< standard deviation of the position from room to room, per coordinate
};

/// Copies of the whole building side by side and on top of each other.
struct Repeat {
  int x = 1, y = 1, storeys = 1;
  double gap = 0.4;  ///< thickness of what lies between two copies' rooms [m]
};

struct Scene {
  std::string name;
  std::uint64_t seed = 1;
  double noise_m = 0;         ///< standard deviation: uniform: per coordinate; tripod: along the beam [m]
  double outliers = 0;        ///< share of the points that lie anywhere in the bounding box
  double holes = 0;           ///< share of the surface without points, in round patches
  double clutter_per_m2 = 0;  ///< random furniture: boxes per square metre of floor
  std::vector<std::string> storeys;
  std::vector<SceneRoom> rooms;
  std::vector<SceneDoor> doors;
  std::vector<SceneWindow> windows;
  std::vector<SceneFurniture> furniture;
  std::vector<SceneShaft> shafts;
  Sampling sampling;
  HandheldErrors handheld;
  Repeat repeat;
};

}  // namespace roomcut::synthesize

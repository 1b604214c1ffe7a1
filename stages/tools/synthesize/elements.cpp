// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/random/counter_random.h"
#include "stages/tools/synthesize/arc_elements.h"
#include "stages/tools/synthesize/column.h"
#include "stages/tools/synthesize/plan.h"
#include "stages/tools/synthesize/room_heights.h"

namespace roomcut::synthesize {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kHighestRoof = 5.0;      // from eaves to ridge [m]
constexpr double kLeastDoor = 1.0;        // a doorway that would be lower is walled up [m]
constexpr double kLeastNiche = 0.3;       // height [m]
constexpr double kThroughWall = 0.3;      // a doorway's box ends within this of its middle [m]
constexpr double kColumnClearance = 0.8;  // from walls, doorways and shafts [m]
constexpr double kNicheClearance = 0.25;  // from corners, doorways, windows and other niches [m]

Vec2 longest_side(const Polygon2& polygon) {
  Vec2 longest(0, 0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 side = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (side.norm() > longest.norm() + 1e-9) longest = side;
  }
  return longest;
}

Vec2 main_direction(const Polygon2& polygon) {
  return longest_side(polygon).normalized();
}

/// Least and greatest coordinate along a direction.
std::array<double, 2> reach(const Polygon2& polygon, const Vec2& direction) {
  std::array<double, 2> ends{1e300, -1e300};
  for (const Vec2& p : polygon) {
    ends = {std::min(ends[0], p.dot(direction)), std::max(ends[1], p.dot(direction))};
  }
  return ends;
}

class ElementMaker {
 public:
  ElementMaker(std::uint64_t seed, std::uint64_t stream, Scene& scene)
      : seed_(seed), stream_(0x656c6500 + stream), scene_(scene) {}

  void add_arcs() {
    synthesize::add_arcs(scene_, [this] { return draw(); });
  }
  void add_roof();
  void add_ramps();
  void add_heights();
  void add_beams();
  void add_columns();
  void add_niches();

 private:
  double draw() { return random_unit(seed_, stream_, counter_++); }
  double draw(double lo, double hi) { return lo + (hi - lo) * draw(); }
  bool chance(double share) { return draw() < share; }

  void raise_floor(SceneRoom& room);
  void build_ramp(SceneRoom& room);
  bool is_free(std::size_t room, const Vec2& p) const;
  void add_niche(std::size_t room, std::size_t side);
  bool opens_near(std::size_t room, const Vec2& p, double half_width) const;
  bool backs_onto_room(std::size_t room, const Vec2& p) const;

  std::uint64_t seed_, stream_, counter_ = 0;
  Scene& scene_;
};

void ElementMaker::add_roof() {
  const int top = static_cast<int>(scene_.storeys.size()) - 1;
  Polygon2 footprint;
  Vec2 along(0, 0);
  double floor = 1e300;
  for (const SceneRoom& room : scene_.rooms) {
    if (room.storey != top) continue;
    if (longest_side(room.polygon).norm() > along.norm() + 1e-6) along = longest_side(room.polygon);
    footprint.insert(footprint.end(), room.polygon.begin(), room.polygon.end());
    floor = std::min(floor, room.floor);
  }
  const double turn = std::atan2(along.y(), along.x()) + (chance(0.5) ? std::numbers::pi / 2 : 0);
  const auto kind = static_cast<RoofKind>(static_cast<int>(draw(0, 3)));
  const Vec2 falls(std::cos(turn), std::sin(turn));
  const auto [from, to] = reach(footprint, falls);
  const double run = (to - from) / (kind == RoofKind::kMonopitch ? 1 : 2);
  const double steepest = std::min(50.0, std::atan(kHighestRoof / run) / kDegree);
  const double pitch = draw(std::min(8.0, steepest), steepest) * kDegree;
  const bool to_floor = chance(0.3) && pitch > 32 * kDegree;
  const double knee = to_floor ? 0 : draw(0.9, 2.3);
  const bool collar = chance(0.3);
  const double collar_height = draw(2.4, 2.7);
  for (SceneRoom& room : scene_.rooms) {
    if (room.storey != top) continue;
    room.slopes = roof(kind, footprint, pitch, turn, floor + knee);
    room.ceiling = floor + (collar ? collar_height : knee + 2 * kHighestRoof);
    settle_heights(room);
  }
}

void ElementMaker::add_ramps() {
  for (std::size_t r = 0; r < scene_.rooms.size(); ++r) {
    const bool stairwell = std::any_of(scene_.shafts.begin(), scene_.shafts.end(),
                                       [&](const SceneShaft& s) { return s.upper == static_cast<int>(r); });
    if (stairwell || !chance(0.35)) continue;
    SceneRoom& room = scene_.rooms[r];
    if (chance(0.5)) {
      raise_floor(room);
    } else {
      build_ramp(room);
    }
    settle_heights(room);
  }
}

/// The whole floor slopes by 1 to 6 %, in any direction.
void ElementMaker::raise_floor(SceneRoom& room) {
  const double pitch = std::atan(draw(0.01, 0.06));
  const double azimuth = draw(-std::numbers::pi, std::numbers::pi);
  const Vec2 falls(std::cos(azimuth), std::sin(azimuth));
  const Vec2 lowest = reach(room.polygon, falls)[1] * falls;
  room.slopes.push_back(sloped(false, {lowest.x(), lowest.y(), room.floor}, pitch, azimuth));
}

/// A ramp of 5 to 12 % across the room, or across a part of its width, up to a platform.
void ElementMaker::build_ramp(SceneRoom& room) {
  const Vec2 u = main_direction(room.polygon);
  const Vec2 v(-u.y(), u.x());
  const auto [u0, u1] = reach(room.polygon, u);
  const auto [v0, v1] = reach(room.polygon, v);
  const double begin = u0 + draw(0.15, 0.3) * (u1 - u0);
  const double end = u0 + draw(0.6, 0.8) * (u1 - u0);
  const double side = chance(0.5) ? v1 + 1 : v0 + draw(0.4, 0.7) * (v1 - v0);
  const double grade = draw(0.05, 0.12);
  const auto box = [&](double a, double b, double c, double d) {
    return Polygon2{a * u + c * v, b * u + c * v, b * u + d * v, a * u + d * v};
  };
  const Vec2 foot = begin * u;
  SceneSlope ramp =
      sloped(false, {foot.x(), foot.y(), room.floor}, std::atan(grade), std::atan2(-u.y(), -u.x()));
  ramp.polygon = box(begin, end, v0 - 1, side);
  SceneSlope platform{false, {0, 0}, room.floor + grade * (end - begin), box(end, u1 + 1, v0 - 1, v1 + 1)};
  room.slopes.insert(room.slopes.end(), {ramp, platform});
}

void ElementMaker::add_heights() {
  const auto off = [this] { return 0.01 * std::floor(draw(0, 4)); };
  for (SceneRoom& room : scene_.rooms) {
    room.floor += off();
    room.ceiling += off();
  }
}

/// Under level ceilings that are high enough.
void ElementMaker::add_beams() {
  for (std::size_t r = 0; r < scene_.rooms.size(); ++r) {
    SceneRoom& room = scene_.rooms[r];
    const double depth = draw(0.15, 0.4);
    const double width = draw(0.2, 0.4);
    const int count = static_cast<int>(draw(1, 4));
    const bool stairwell = std::any_of(scene_.shafts.begin(), scene_.shafts.end(),
                                       [&](const SceneShaft& s) { return s.lower == static_cast<int>(r); });
    if (!chance(0.5) || stairwell || !room.level_ceiling || room.ceiling - room.floor - depth < 2.2) continue;
    const Vec2 u = main_direction(room.polygon);
    const Vec2 v(-u.y(), u.x());
    const auto [u0, u1] = reach(room.polygon, u);
    const auto [v0, v1] = reach(room.polygon, v);
    for (int i = 1; i <= count; ++i) {
      const Vec2 a = (u0 + i * (u1 - u0) / (count + 1) - width / 2) * u;
      const Vec2 b = a + width * u;
      const Vec2 near = (v0 - 1) * v;
      const Vec2 far = (v1 + 1) * v;
      room.slopes.push_back({true, {0, 0}, room.ceiling - depth, {a + near, b + near, b + far, a + far}});
    }
  }
}

bool ElementMaker::is_free(std::size_t r, const Vec2& p) const {
  const SceneRoom& room = scene_.rooms[r];
  if (!contains(room.polygon, p) || border_distance(room.polygon, p) < kColumnClearance) return false;
  for (const SceneDoor& door : scene_.doors) {
    if ((door.at - p).norm() < door.width / 2 + kColumnClearance) return false;
  }
  return std::none_of(scene_.shafts.begin(), scene_.shafts.end(), [&](const SceneShaft& shaft) {
    return contains(shaft.polygon, p) || border_distance(shaft.polygon, p) < kColumnClearance;
  });
}

/// In a grid along the room's longest side; all of a room are alike.
void ElementMaker::add_columns() {
  for (std::size_t r = 0; r < scene_.rooms.size(); ++r) {
    SceneRoom& room = scene_.rooms[r];
    const Vec2 u = main_direction(room.polygon);
    const Vec2 v(-u.y(), u.x());
    const double spacing = draw(2.4, 4.0);
    const bool round = chance(0.5);
    const double size = 0.05 * std::round(draw(0.2, 0.6) / 0.05);
    const double other = chance(0.5) ? size : 0.05 * std::round(draw(0.2, 0.6) / 0.05);
    const double turn = std::atan2(u.y(), u.x()) + (chance(0.3) ? draw(0, std::numbers::pi / 2) : 0);
    const Vec2 first = innermost_point(room.polygon);
    for (int i = -20; i <= 20; ++i) {
      for (int j = -20; j <= 20; ++j) {
        const Vec2 p = first + spacing * (i * u + j * v);
        if (!is_free(r, p)) continue;
        room.columns.push_back(round ? round_column(p, size) : rectangular_column(p, size, other, turn));
      }
    }
  }
}

bool ElementMaker::opens_near(std::size_t r, const Vec2& p, double half_width) const {
  const auto near = [&](const Vec2& at, double width) {
    return (at - p).norm() < half_width + width / 2 + kNicheClearance;
  };
  return std::any_of(scene_.doors.begin(), scene_.doors.end(),
                     [&](const SceneDoor& door) { return near(door.at, door.width); }) ||
         std::any_of(scene_.windows.begin(), scene_.windows.end(), [&](const SceneWindow& window) {
           return window.room == static_cast<int>(r) && near(window.at, window.width);
         });
}

/// Whether another room of the storey lies within 0.6 m of p.
bool ElementMaker::backs_onto_room(std::size_t r, const Vec2& p) const {
  for (std::size_t i = 0; i < scene_.rooms.size(); ++i) {
    const SceneRoom& other = scene_.rooms[i];
    if (i == r || other.storey != scene_.rooms[r].storey) continue;
    if (contains(other.polygon, p) || border_distance(other.polygon, p) < 0.6) return true;
  }
  return false;
}

void ElementMaker::add_niche(std::size_t r, std::size_t side) {
  SceneRoom& room = scene_.rooms[r];
  const Vec2& a = room.polygon[side];
  const Vec2 ab = room.polygon[(side + 1) % room.polygon.size()] - a;
  SceneNiche niche;
  niche.width = draw(0.25, 1.0);
  niche.depth = draw(0.05, 0.3);
  const bool part = chance(0.4);
  const double share = draw();
  const double sill = draw(0.2, 0.9);
  const double height = draw(0.8, 1.4);
  const double margin = niche.width / 2 + kNicheClearance;
  if (ab.norm() < 2 * margin) return;
  niche.at = a + (margin + share * (ab.norm() - 2 * margin)) * ab.normalized();
  if (opens_near(r, niche.at, niche.width / 2)) return;
  const Vec2 outwards = Vec2(ab.y(), -ab.x()).normalized();
  const bool recess = chance(0.6);
  if (backs_onto_room(r, niche.at + niche.depth * outwards) || !recess) {
    niche.depth = -niche.depth;
  } else if (part) {
    niche.sill = sill;
    niche.height = height;
  }
  room.niches.push_back(niche);
}

void ElementMaker::add_niches() {
  for (std::size_t r = 0; r < scene_.rooms.size(); ++r) {
    for (std::size_t side = 0; side < scene_.rooms[r].polygon.size(); ++side) {
      if (chance(0.7)) add_niche(r, side);
    }
  }
}

/// Lowest ceiling over and highest floor under a round place, in one room.
std::array<double, 2> room_between(const SceneRoom& room, const Vec2& centre, double radius) {
  std::array<double, 2> ends{floor_at(room, centre), ceiling_at(room, centre)};
  for (int i = 0; i < 16; ++i) {
    const double angle = i * std::numbers::pi / 8;
    const Vec2 p = centre + radius * Vec2(std::cos(angle), std::sin(angle));
    ends = {std::max(ends[0], floor_at(room, p)), std::min(ends[1], ceiling_at(room, p))};
  }
  return ends;
}

/// Lowers what is too high under a slope, and drops what does not fit at all.
void fit_openings(Scene& scene) {
  std::erase_if(scene.doors, [&](SceneDoor& door) {
    const double radius = std::hypot(door.width / 2, kThroughWall);
    const auto a = room_between(scene.rooms[static_cast<std::size_t>(door.room_a)], door.at, radius);
    const auto b = room_between(scene.rooms[static_cast<std::size_t>(door.room_b)], door.at, radius);
    const double free = std::min(a[1], b[1]) - std::max(a[0], b[0]) - door.sill;
    door.height = std::min(door.height, free - 0.1);
    return door.height < kLeastDoor;
  });
  std::erase_if(scene.windows, [&](const SceneWindow& window) {
    const SceneRoom& room = scene.rooms[static_cast<std::size_t>(window.room)];
    const auto [floor, ceiling] = room_between(room, window.at, window.width / 2 + 0.05);
    return floor + window.sill + window.height > ceiling - 0.05;
  });
  for (SceneRoom& room : scene.rooms) {
    std::erase_if(room.niches, [&](SceneNiche& niche) {
      const auto [floor, ceiling] = room_between(room, niche.at, std::hypot(niche.width / 2, 0.05));
      if (niche.height > 0) niche.height = std::min(niche.height, ceiling - floor - niche.sill - 0.1);
      return niche.height < 0 || ceiling < floor + kLeastNiche;
    });
  }
  std::erase_if(scene.shafts, [&](const SceneShaft& shaft) {
    const SceneRoom& lower = scene.rooms[static_cast<std::size_t>(shaft.lower)];
    const SceneRoom& upper = scene.rooms[static_cast<std::size_t>(shaft.upper)];
    return std::any_of(shaft.polygon.begin(), shaft.polygon.end(), [&](const Vec2& p) {
      return surface_at(lower, p, true) >= 0 || surface_at(upper, p, false) >= 0 ||
             ceiling_at(upper, p) < upper.floor + kLeastDoor;
    });
  });
}

struct Element {
  const char* name;
  void (ElementMaker::*add)();
};
constexpr Element kElements[] = {
    {"heights", &ElementMaker::add_heights}, {"arcs", &ElementMaker::add_arcs},
    {"roof", &ElementMaker::add_roof},       {"ramps", &ElementMaker::add_ramps},
    {"beams", &ElementMaker::add_beams},     {"columns", &ElementMaker::add_columns},
    {"niches", &ElementMaker::add_niches}};

}  // namespace

const std::vector<std::string>& element_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Element& element : kElements) names.emplace_back(element.name);
    return names;
  }();
  return kNames;
}

void add_elements(const std::vector<std::string>& elements, std::uint64_t seed, Scene& scene) {
  std::uint64_t stream = 0;
  for (const Element& element :
       kElements) {  // in an order of their own: columns stand clear of what is there
    ++stream;
    if (std::find(elements.begin(), elements.end(), element.name) == elements.end()) continue;
    ElementMaker maker(seed, stream, scene);
    (maker.*element.add)();
  }
  if (!elements.empty()) fit_openings(scene);
}

}  // namespace roomcut::synthesize

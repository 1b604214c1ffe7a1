// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "common/random/counter_random.h"
#include "stages/tools/synthesize/elements.h"
#include "stages/tools/synthesize/floor_plan.h"
#include "stages/tools/synthesize/plan.h"

namespace roomcut::synthesize {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Ranges that make a family; lengths in metres.
struct Family {
  const char* name;
  double width[2], depth[2];  // of the footprint
  double wall[2];             // inner walls
  double room_area[2];
  int storeys[2];
  double height[2];    // storey: floor to the highest ceiling
  double split_angle;  // walls leave the right angle by up to this [degrees]
  bool corridor, cut_corner, arc;
  double lowered;  // share of the rooms with a lower ceiling
  double raised;   // share of the rooms with a raised floor
  double windows;  // share of the outer walls with a window
};

constexpr Family kFamilies[] = {
    {"office",
     {18, 28},
     {12, 16},
     {0.10, 0.20},
     {14, 30},
     {1, 2},
     {2.7, 3.2},
     0,
     true,
     false,
     false,
     0.4,
     0.05,
     0.7},
    {"oblique",
     {16, 24},
     {12, 16},
     {0.10, 0.25},
     {15, 35},
     {1, 2},
     {2.6, 3.2},
     18,
     false,
     true,
     false,
     0.3,
     0.15,
     0.5},
    {"multi_storey",
     {14, 20},
     {10, 14},
     {0.12, 0.24},
     {14, 28},
     {3, 4},
     {2.5, 2.9},
     0,
     true,
     false,
     false,
     0.2,
     0.1,
     0.6},
    {"house",
     {9, 12},
     {8, 10},
     {0.10, 0.24},
     {10, 22},
     {2, 2},
     {2.4, 2.7},
     0,
     false,
     false,
     false,
     0.1,
     0.1,
     0.6},
    {"thin",
     {14, 22},
     {10, 14},
     {0.06, 0.10},
     {10, 22},
     {1, 2},
     {2.5, 3.0},
     0,
     true,
     false,
     false,
     0.3,
     0.1,
     0.5},
    {"curved",
     {16, 22},
     {12, 15},
     {0.12, 0.24},
     {16, 32},
     {1, 2},
     {2.7, 3.2},
     6,
     false,
     false,
     true,
     0.2,
     0.1,
     0.4},
};

class Generator {
 public:
  Generator(const FamilySpec& spec, const Family& family, Scene& scene)
      : spec_(spec), family_(family), scene_(scene) {}

  void generate() {
    const double turn = draw(0, std::numbers::pi / 2);
    const Lot footprint = make_footprint();
    const int storeys = spec_.storeys > 0
                            ? spec_.storeys
                            : static_cast<int>(draw(family_.storeys[0], family_.storeys[1] + 1));
    double floor = 0;
    std::vector<int> below;
    for (int s = 0; s < storeys; ++s) {
      const double height = std::round(draw(family_.height) * 20) / 20;
      std::vector<int> rooms = add_storey(footprint, floor, height, turn);
      if (spec_.shafts && s > 0) add_shaft(below, rooms, s);
      below = std::move(rooms);
      floor += height + std::round(draw(0.2, 0.4) * 20) / 20;
    }
    add_elements(spec_.elements, spec_.seed, scene_);
    close_rooms();
  }

 private:
  double draw() { return random_unit(spec_.seed, 0x66616d69, counter_++); }
  double draw(double lo, double hi) { return lo + (hi - lo) * draw(); }
  double draw(const double (&range)[2]) { return draw(range[0], range[1]); }

  Lot make_footprint();
  std::vector<Lot> split_storey(const Lot& footprint);
  void split(const Lot& lot, double target, std::vector<Lot>& leaves);
  std::vector<int> add_storey(const Lot& footprint, double floor, double height, double turn);
  void add_doors(const std::vector<Lot>& lots, const std::vector<int>& rooms, double turn);
  void add_windows(const Lot& lot, int room, double turn);
  void add_shaft(const std::vector<int>& below, const std::vector<int>& above, int storey);
  void close_rooms();

  const FamilySpec& spec_;
  const Family& family_;
  Scene& scene_;
  std::uint64_t counter_ = 0;
};

Lot Generator::make_footprint() {
  double w = draw(family_.width);
  const double d = draw(family_.depth);
  if (spec_.rooms > 0) w = std::max(w, spec_.rooms * 0.5 * (family_.room_area[0] + family_.room_area[1]) / d);
  Lot lot;
  lot.corners = {{0, 0}, {w, 0}, {w, d}, {0, d}};
  if (family_.cut_corner)
    lot.corners = {{0, 0}, {w, 0}, {w - draw(1, 4), d}, {draw(3, 6), d}, {0, d - draw(3, 6)}};
  if (family_.arc) {
    lot.corners = {{0, 0}, {w, 0}};
    const Vec2 through(w + draw(1.5, 4), d / 2);
    for (const Vec2& p : arc_points({w, 0}, through, {w, d}, static_cast<int>(draw(10, 24))))
      lot.corners.push_back(p);
    lot.corners.emplace_back(0, d);
  }
  lot.wall.assign(lot.corners.size(), 0);
  return lot;
}

std::vector<Lot> Generator::split_storey(const Lot& footprint) {
  const double target = draw(family_.room_area);
  std::vector<Lot> leaves;
  if (!family_.corridor) {
    split(footprint, target, leaves);
    return leaves;
  }
  const double depth = footprint.corners[2].y();
  const double width = draw(1.6, 2.4);
  const double y = draw(0.35, 0.65) * depth - width / 2;
  const double wall = draw(family_.wall);
  const auto [south, rest] = split_lot(footprint, {0, y}, {1, 0}, wall);
  const auto [corridor, north] = split_lot(rest, {0, y + width}, {1, 0}, wall);
  split(south, target, leaves);
  split(north, target, leaves);
  leaves.push_back(corridor);
  return leaves;
}

/// Halves the lot across its longer extent until it is a room.
void Generator::split(const Lot& lot, double target, std::vector<Lot>& leaves) {
  const double area = doubled_area(lot.corners) / 2;
  const bool small = area < target * draw(1.0, 1.8);
  for (int attempt = 0; attempt < 32 && !small; ++attempt) {
    const bool across_x = extent(lot, {1, 0}) > extent(lot, {0, 1});
    const double angle = (across_x ? 90 : 0) * kDegree + draw(-1, 1) * family_.split_angle * kDegree;
    const Vec2 direction(std::cos(angle), std::sin(angle));
    const Vec2 normal(-direction.y(), direction.x());
    const Vec2 through = polygon_centroid(lot.corners) + draw(-0.15, 0.15) * extent(lot, normal) * normal;
    const auto [left, right] = split_lot(lot, through, direction, draw(family_.wall));
    if (is_room(left) && is_room(right)) {
      split(left, target, leaves);
      split(right, target, leaves);
      return;
    }
  }
  leaves.push_back(lot);
}

std::vector<int> Generator::add_storey(const Lot& footprint, double floor, double height, double turn) {
  const int storey = static_cast<int>(scene_.storeys.size());
  scene_.storeys.push_back("storey " + std::to_string(storey));
  const double lowered = std::round(draw(0.15, 0.45) * 20) / 20;
  const double raised = std::round(draw(0.1, 0.3) * 20) / 20;
  std::vector<Lot> lots;
  std::vector<int> rooms;
  for (const Lot& lot : split_storey(footprint)) {
    SceneRoom room;
    room.name = "r" + std::to_string(storey) + "_" + std::to_string(lots.size());
    room.storey = storey;
    std::vector<double> half;
    for (const double w : lot.wall) half.push_back(w / 2);
    room.polygon = turned(inset(lot.corners, half), turn);
    room.floor = floor + (draw() < family_.raised ? raised : 0);
    room.ceiling = floor + height - (draw() < family_.lowered ? lowered : 0);
    if (room.ceiling - room.floor < 2.2) room.floor = floor;
    rooms.push_back(static_cast<int>(scene_.rooms.size()));
    scene_.rooms.push_back(room);
    lots.push_back(lot);
    add_windows(lot, rooms.back(), turn);
  }
  if (spec_.doors) add_doors(lots, rooms, turn);
  return rooms;
}

/// A spanning tree of doors over the common walls in random order, and some more.
void Generator::add_doors(const std::vector<Lot>& lots, const std::vector<int>& rooms, double turn) {
  std::vector<Contact> contacts = find_contacts(lots, 1.7);
  std::vector<double> order;
  for (std::size_t i = 0; i < contacts.size(); ++i) order.push_back(draw());
  std::vector<std::size_t> by_chance(contacts.size());
  for (std::size_t i = 0; i < by_chance.size(); ++i) by_chance[i] = i;
  std::sort(by_chance.begin(), by_chance.end(),
            [&](std::size_t a, std::size_t b) { return order[a] < order[b]; });
  std::vector<std::size_t> group(lots.size());
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = i;
  for (const std::size_t i : by_chance) {
    const Contact& contact = contacts[i];
    const double share = draw(0.4, 0.6);
    const double width = draw(0.8, 1.0);
    const bool joins = group[contact.a] != group[contact.b];
    if (!joins && draw() > 0.15) continue;
    const std::size_t from = group[contact.b];
    std::replace(group.begin(), group.end(), from, group[contact.a]);
    SceneDoor door;
    door.room_a = rooms[contact.a];
    door.room_b = rooms[contact.b];
    door.at = turned({contact.from + share * (contact.to - contact.from)}, turn)[0];
    door.width = width;
    const SceneRoom& a = scene_.rooms[door.room_a];
    const SceneRoom& b = scene_.rooms[door.room_b];
    door.height = std::min(2.05, std::min(a.ceiling, b.ceiling) - std::max(a.floor, b.floor) - 0.1);
    scene_.doors.push_back(door);
  }
}

void Generator::add_windows(const Lot& lot, int room, double turn) {
  for (std::size_t i = 0; i < lot.corners.size(); ++i) {
    const Vec2& a = lot.corners[i];
    const Vec2& b = lot.corners[(i + 1) % lot.corners.size()];
    const double width = draw(1.0, 1.8);
    if (lot.wall[i] > 0 || (b - a).norm() < width + 0.8 || draw() > family_.windows) continue;
    SceneWindow window;
    window.room = room;
    window.at = turned({0.5 * (a + b)}, turn)[0];
    window.width = width;
    window.height = draw(1.0, 1.3);
    window.sill = 0.8;
    window.depth = draw(0.08, 0.2);
    if (scene_.rooms[room].floor + window.sill + window.height < scene_.rooms[room].ceiling - 0.05) {
      scene_.windows.push_back(window);
    }
  }
}

/// A stairwell where a room of the storey below and one above have most space in common.
void Generator::add_shaft(const std::vector<int>& below, const std::vector<int>& above, int storey) {
  SceneShaft best;
  double best_clearance = 0.8;
  Vec2 centre(0, 0);
  for (const int lower : below) {
    for (const int upper : above) {
      for (const int room : {lower, upper}) {
        const Vec2 p = innermost_point(scene_.rooms[room].polygon);
        if (!contains(scene_.rooms[lower].polygon, p) || !contains(scene_.rooms[upper].polygon, p)) continue;
        const double clearance = std::min(border_distance(scene_.rooms[lower].polygon, p),
                                          border_distance(scene_.rooms[upper].polygon, p));
        if (clearance <= best_clearance) continue;
        best_clearance = clearance;
        best.lower = lower;
        best.upper = upper;
        centre = p;
      }
    }
  }
  if (best_clearance <= 0.8 || storey == 0) return;
  const double half = std::min(1.1, best_clearance / std::sqrt(2.0) - 0.1);
  const Vec2 side =
      (scene_.rooms[best.lower].polygon[1] - scene_.rooms[best.lower].polygon[0]).normalized() * half;
  const Vec2 other(-side.y(), side.x());
  best.polygon = {centre - side - other, centre + side - other, centre + side + other, centre - side + other};
  scene_.shafts.push_back(best);
}

/// Chooses the rooms that no scanner enters, in random order; the building itself stays the same.
void Generator::close_rooms() {
  const std::size_t wanted = static_cast<std::size_t>(std::lround(spec_.unscanned * scene_.rooms.size()));
  std::vector<std::size_t> order(scene_.rooms.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t room) { return random_unit(spec_.seed, 0x636c6f73, room); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  std::vector<bool> needed(order.size(), false);  // to look from into a closed room
  std::size_t closed = 0;
  for (const std::size_t room : order) {
    if (closed == wanted) return;
    if (needed[room]) continue;
    for (const SceneDoor& door : scene_.doors) {
      const auto a = static_cast<std::size_t>(door.room_a);
      const auto b = static_cast<std::size_t>(door.room_b);
      const std::size_t other = a == room ? b : a;
      if ((a != room && b != room) || !scene_.rooms[other].scanned) continue;
      needed[other] = true;
      scene_.rooms[room].scanned = false;
      ++closed;
      break;
    }
  }
}

}  // namespace

const std::vector<std::string>& family_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Family& family : kFamilies) names.emplace_back(family.name);
    return names;
  }();
  return kNames;
}

void add_random_building(const FamilySpec& spec, Scene& scene) {
  for (const Family& family : kFamilies) {
    if (spec.family == family.name) Generator(spec, family, scene).generate();
  }
}

}  // namespace roomcut::synthesize

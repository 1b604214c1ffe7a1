// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/building.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "common/errors/codes.h"
#include "stages/tools/synthesize/plan.h"
#include "stages/tools/synthesize/room_heights.h"
#include "stages/tools/synthesize/scene_limits.h"
#include "stages/tools/synthesize/stations.h"

namespace roomcut::synthesize {

namespace {

constexpr double kOverlap =
    0.04;  // a doorway's box reaches this far into both rooms, where the union absorbs it [m]
constexpr double kThickestWall = 3.0;  // a doorway is no longer than this [m]

double micrometres(double z) {
  return std::round(z * 1e6) / 1e6;
}

/// Distance from p along `direction` to the first side of the polygon.
std::optional<double> shoot(const Polygon2& polygon, const Vec2& p, const Vec2& direction) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - p;
    const Vec2 ab = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double det = direction.x() * ab.y() - direction.y() * ab.x();
    if (std::abs(det) < 1e-12) continue;
    const double distance = (a.x() * ab.y() - a.y() * ab.x()) / det;
    const double along = (a.x() * direction.y() - a.y() * direction.x()) / det;
    if (distance > 0 && along >= 0 && along <= 1) best = std::min(best, distance);
  }
  if (best > kThickestWall) return std::nullopt;
  return best;
}

class Placer {
 public:
  explicit Placer(const Scene& scene) : scene_(scene) {}
  Building place();

 private:
  void add_rooms();
  void add_door(const SceneDoor& door, std::size_t index);
  void add_window(const SceneWindow& window, std::size_t index);
  void add_shaft(const SceneShaft& shaft, std::size_t index);
  void add_solids();
  void add_niche(std::size_t room, std::size_t index);
  std::optional<WallOpening> opening(const Polygon2& polygon, const Vec2& at, double width) const;
  void problem(const std::string& where, const std::string& what, const std::string& hint = "") {
    problems_.push_back(
        {errors::kSceneInvalid, scene_.name + ": " + where, what, hint.empty() ? kSceneRemedy : hint});
  }

  const Scene& scene_;
  Building building_;
  std::vector<Problem> problems_;
};

Building Placer::place() {
  add_rooms();
  add_solids();
  for (std::size_t r = 0; r < scene_.rooms.size(); ++r) {
    for (std::size_t i = 0; i < scene_.rooms[r].niches.size(); ++i) add_niche(r, i);
  }
  for (std::size_t i = 0; i < scene_.doors.size(); ++i) add_door(scene_.doors[i], i);
  for (std::size_t i = 0; i < scene_.windows.size(); ++i) add_window(scene_.windows[i], i);
  for (std::size_t i = 0; i < scene_.shafts.size(); ++i) add_shaft(scene_.shafts[i], i);
  if (!problems_.empty()) refuse_scene(problems_);
  building_.furniture = scene_.furniture;
  if (scene_.clutter_per_m2 > 0) furnish(scene_, building_);
  place_stations(scene_, building_);
  return building_;
}

void Placer::add_rooms() {
  building_.lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  building_.hi = -building_.lo;
  for (std::size_t i = 0; i < scene_.rooms.size(); ++i) {
    const SceneRoom& room = scene_.rooms[i];
    const Prism prism{room.polygon, micrometres(room.floor), micrometres(room.ceiling), static_cast<int>(i),
                      -1};
    for (const Vec2& p : prism.polygon) {
      building_.lo = building_.lo.cwiseMin(Vec3(p.x(), p.y(), prism.z0));
      building_.hi = building_.hi.cwiseMax(Vec3(p.x(), p.y(), prism.z1));
    }
    building_.prisms.push_back(prism);
  }
}

/// The place on the side of the room nearest to `at`; none when the width does not fit on that side.
std::optional<WallOpening> Placer::opening(const Polygon2& polygon, const Vec2& at, double width) const {
  const std::size_t side = nearest_side(polygon, at);
  const Vec2& a = polygon[side];
  const Vec2 ab = polygon[(side + 1) % polygon.size()] - a;
  WallOpening result;
  result.right = ab.normalized();
  result.outwards = Vec2(result.right.y(), -result.right.x());
  const double t = (at - a).dot(result.right);
  if (t - width / 2 < 0.005 || t + width / 2 > ab.norm() - 0.005) return std::nullopt;
  result.centre = a + t * result.right;
  result.width = width;
  return result;
}

void Placer::add_door(const SceneDoor& door, std::size_t index) {
  const std::string where = "doors[" + std::to_string(index) + "]";
  const SceneRoom& a = scene_.rooms[door.room_a];
  const SceneRoom& b = scene_.rooms[door.room_b];
  auto place = opening(a.polygon, door.at, door.width);
  if (!place) {
    problem(where, "does not fit on the nearest wall of room \"" + a.name + "\"",
            "move \"at\" or make it narrower");
    return;
  }
  const Vec2 jamb0 = place->centre - door.width / 2 * place->right;
  const Vec2 jamb1 = place->centre + door.width / 2 * place->right;
  const auto d0 = shoot(b.polygon, jamb0, place->outwards);
  const auto d1 = shoot(b.polygon, jamb1, place->outwards);
  if (!d0 || !d1) {
    problem(where, "room \"" + b.name + "\" is not behind this wall of room \"" + a.name + "\"",
            "\"at\" must be near the wall between the two rooms");
    return;
  }
  place->depth = std::max(*d0, *d1);
  place->room_a = door.room_a;
  place->room_b = door.room_b;
  const Vec2& out = place->outwards;
  const Polygon2 box{jamb0 - kOverlap * out, jamb0 + (*d0 + kOverlap) * out, jamb1 + (*d1 + kOverlap) * out,
                     jamb1 - kOverlap * out};
  double floor = std::max(a.floor, b.floor);
  double ceiling = std::min(a.ceiling, b.ceiling);
  const auto clear = [&](const SceneRoom& room, std::initializer_list<Vec2> places) {
    for (const Vec2& p : places) {
      floor = std::max(floor, floor_at(room, p));
      ceiling = std::min(ceiling, ceiling_at(room, p));
    }
  };
  clear(a, {box[0], jamb0, jamb1, box[3]});
  // A round wall of b may come nearer between the jambs, up to the wall of a.
  clear(b, {jamb0, jamb1, box[1], Vec2(jamb0 + *d0 * out), Vec2(jamb1 + *d1 * out), box[2]});
  place->z0 = micrometres(floor + door.sill);
  place->z1 = micrometres(place->z0 + door.height);
  if (place->z1 > ceiling + 1e-9) {
    problem(where, "is higher than the lower of the two rooms' ceilings");
    return;
  }
  building_.prisms.push_back({box, place->z0, place->z1, door.room_a, door.room_b});
  building_.doors.push_back(*place);
}

void Placer::add_window(const SceneWindow& window, std::size_t index) {
  const std::string where = "windows[" + std::to_string(index) + "]";
  const SceneRoom& room = scene_.rooms[window.room];
  auto place = opening(room.polygon, window.at, window.width);
  if (!place) {
    problem(where, "does not fit on the nearest wall of room \"" + room.name + "\"",
            "move \"at\" or make it narrower");
    return;
  }
  const Vec2 half = window.width / 2 * place->right;
  const std::array<Vec2, 2> ends{place->centre - half, place->centre + half};
  double floor = room.floor;
  double ceiling = room.ceiling;
  for (const Vec2& end : ends) {
    floor = std::max(floor, floor_at(room, end));
    ceiling = std::min(ceiling, ceiling_at(room, end));
  }
  place->z0 = micrometres(floor + window.sill);
  place->z1 = micrometres(place->z0 + window.height);
  if (place->z1 > ceiling) problem(where, "reaches through the ceiling of room \"" + room.name + "\"");
  place->depth = window.depth;
  place->room_a = window.room;
  building_.windows.push_back(*place);
}

void Placer::add_shaft(const SceneShaft& shaft, std::size_t index) {
  const SceneRoom& lower = scene_.rooms[shaft.lower];
  const SceneRoom& upper = scene_.rooms[shaft.upper];
  const double z0 = micrometres(lower.ceiling);
  const double z1 = micrometres(upper.floor);
  const auto inside = [&](const SceneRoom& room) {
    return !borders_cross(room.polygon, shaft.polygon) &&
           std::all_of(shaft.polygon.begin(), shaft.polygon.end(),
                       [&](const Vec2& p) { return contains(room.polygon, p); });
  };
  const bool level = std::all_of(shaft.polygon.begin(), shaft.polygon.end(), [&](const Vec2& p) {
    return surface_at(lower, p, true) < 0 && surface_at(upper, p, false) < 0;
  });
  if (!level) {
    problem("shafts[" + std::to_string(index) + "]",
            "lies under a slope of \"" + lower.name + "\" or over one of \"" + upper.name + "\"");
    return;
  }
  if (z0 >= z1 || !inside(lower) || !inside(upper)) {
    problem("shafts[" + std::to_string(index) + "]",
            "must lie inside the plans of both rooms, \"" + lower.name + "\" below \"" + upper.name + "\"");
    return;
  }
  building_.prisms.push_back({shaft.polygon, z0, z1, shaft.lower, shaft.upper});
}

void Placer::add_solids() {
  for (std::size_t r = 0; r < scene_.rooms.size(); ++r) {
    for (std::size_t i = 0; i < scene_.rooms[r].columns.size(); ++i) {
      const SceneColumn& column = scene_.rooms[r].columns[i];
      if (!contains(scene_.rooms[r].polygon, column.centre)) {
        problem("columns[" + std::to_string(i) + "] of room \"" + scene_.rooms[r].name + "\"",
                "stands outside of the room");
      }
      building_.solids.push_back({column.polygon, static_cast<int>(r)});
    }
  }
}

void Placer::add_niche(std::size_t r, std::size_t index) {
  const SceneRoom& room = scene_.rooms[r];
  const SceneNiche& niche = room.niches[index];
  const std::string where = "niches[" + std::to_string(index) + "] of room \"" + room.name + "\"";
  const auto place = opening(room.polygon, niche.at, niche.width);
  if (!place) {
    problem(where, "does not fit on the nearest wall", "move \"at\" or make it narrower");
    return;
  }
  const Vec2 half = niche.width / 2 * place->right;
  const Vec2 to = niche.depth * place->outwards;
  const Vec2 over = (niche.depth > 0 ? -kOverlap : kOverlap) * place->outwards;  // the union absorbs it
  const auto box = [&](const Vec2& near, const Vec2& far) {
    Polygon2 corners{place->centre - half + near, place->centre - half + far, place->centre + half + far,
                     place->centre + half + near};
    if (doubled_area(corners) < 0) std::reverse(corners.begin(), corners.end());
    return corners;
  };
  double floor = room.floor;
  double ceiling = room.ceiling;
  for (const Vec2& p : box(over, {0, 0})) {
    floor = std::max(floor, floor_at(room, p));
    ceiling = std::min(ceiling, ceiling_at(room, p));
  }
  PlacedNiche placed{box({0, 0}, to), micrometres(floor + niche.sill), micrometres(ceiling),
                     niche.width,     std::abs(niche.depth),           static_cast<int>(r),
                     niche.depth < 0};
  if (niche.height > 0) placed.z1 = micrometres(placed.z0 + niche.height);
  if (placed.z1 > ceiling + 1e-6 || placed.z1 <= placed.z0) {
    problem(where, "reaches through the ceiling, or is of no height");
    return;
  }
  building_.niches.push_back(placed);
  if (placed.solid) {
    building_.solids.push_back({box(over, to), placed.room});
    return;
  }
  building_.prisms.push_back({box(over, to), placed.z0, placed.z1, placed.room, placed.room});
  for (const Vec2& p : placed.polygon) {
    building_.lo = building_.lo.cwiseMin(Vec3(p.x(), p.y(), placed.z0));
    building_.hi = building_.hi.cwiseMax(Vec3(p.x(), p.y(), placed.z1));
  }
}

}  // namespace

Building place(const Scene& scene) {
  return Placer(scene).place();
}

bool in_plan(const SceneFurniture& box, const Vec2& p, double margin) {
  const Vec2 x(std::cos(box.rotation), std::sin(box.rotation));
  const Vec2 y(-x.y(), x.x());
  const Vec2 d = p - box.centre;
  return std::abs(d.dot(x)) <= box.size_x / 2 + margin && std::abs(d.dot(y)) <= box.size_y / 2 + margin;
}

}  // namespace roomcut::synthesize

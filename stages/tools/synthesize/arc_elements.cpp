// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/arc_elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "stages/tools/synthesize/column.h"
#include "stages/tools/synthesize/plan.h"

namespace roomcut::synthesize {

namespace {

constexpr double kCorner = 0.35;     // straight wall that stays beside an arc [m]
constexpr double kPassage = 0.8;     // from a bay to the other walls of the room that it reaches into [m]
constexpr double kOpening = 0.25;    // from an arc to a door or window [m]
constexpr double kThickest = 0.35;   // wall that a bay bulges through [m]
constexpr double kOutside = 0.35;    // from what bulges outwards to other rooms [m]
constexpr double kLeastChord = 1.5;  // of a bay [m]
constexpr double kTowerWall = 0.25;  // between a tower and its room [m]
constexpr double kStraight = 1.0;    // a side this long is no chord of an arc [m]

struct Side {
  Vec2 from, to;
  Vec2 along() const { return (to - from).normalized(); }
  Vec2 outwards() const { return {along().y(), -along().x()}; }
  double length() const { return (to - from).norm(); }
};

Side side_of(const Polygon2& polygon, std::size_t i) {
  return {polygon[i], polygon[(i + 1) % polygon.size()]};
}

double distance(const Side& side, const Vec2& p) {
  const double t = std::clamp((p - side.from).dot(side.along()), 0.0, side.length());
  return (p - side.from - t * side.along()).norm();
}

/// A bulge on a side of a room.
struct Bay {
  std::size_t side;
  Vec2 middle;  ///< of its chord
  double half;  ///< of its chord
  Vec2 apex, centre;
  double radius;
};

class ArcMaker {
 public:
  ArcMaker(Scene& scene, const std::function<double()>& draw) : scene_(scene), draw_(draw) {}

  void make() {
    const std::size_t rooms = scene_.rooms.size();  // towers are added behind them
    for (std::size_t r = 0; r < rooms; ++r) {
      if (draw_() < 0.6) add_bay(r);
      if (draw_() < 0.3) round_corner(r);
      if (draw_() < 0.25) add_tower(r);
    }
  }

 private:
  double draw(double lo, double hi) { return lo + (hi - lo) * draw_(); }

  /// A straight side of the room that is free of openings over its middle part.
  std::optional<std::size_t> long_side(std::size_t r, double least) {
    const Polygon2& polygon = scene_.rooms[r].polygon;
    const auto first = static_cast<std::size_t>(draw_() * static_cast<double>(polygon.size()));
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const std::size_t i = (first + k) % polygon.size();
      if (side_of(polygon, i).length() >= least) return i;
    }
    return std::nullopt;
  }

  bool opens_near(const Vec2& p, double half_width) const {
    const auto near = [&](const Vec2& at, double width) {
      return (at - p).norm() < half_width + width / 2 + kOpening;
    };
    return std::any_of(scene_.doors.begin(), scene_.doors.end(),
                       [&](const SceneDoor& door) { return near(door.at, door.width); }) ||
           std::any_of(scene_.windows.begin(), scene_.windows.end(),
                       [&](const SceneWindow& window) { return near(window.at, window.width); });
  }

  bool has_shaft(std::size_t r) const {
    return std::any_of(scene_.shafts.begin(), scene_.shafts.end(), [&](const SceneShaft& shaft) {
      return shaft.lower == static_cast<int>(r) || shaft.upper == static_cast<int>(r);
    });
  }

  /// The least distance of p to the other rooms of a storey but two; 0 inside of one.
  double clearance(std::size_t r, int behind, const Vec2& p) const {
    double least = 1e9;
    for (std::size_t i = 0; i < scene_.rooms.size(); ++i) {
      const SceneRoom& other = scene_.rooms[i];
      if (i == r || static_cast<int>(i) == behind || other.storey != scene_.rooms[r].storey) continue;
      least = std::min(least, contains(other.polygon, p) ? 0 : border_distance(other.polygon, p));
    }
    return least;
  }

  void add_bay(std::size_t r);
  bool reach_into(const Bay& bay, const Side& side, std::size_t behind);
  int room_behind(std::size_t r, const Bay& bay, const Side& side) const;
  void round_corner(std::size_t r);
  void add_tower(std::size_t r);
  void clear_windows(std::size_t r, const Vec2& p, double half_width) {
    std::erase_if(scene_.windows, [&](const SceneWindow& window) {
      return window.room == static_cast<int>(r) &&
             (window.at - p).norm() < half_width + window.width / 2 + kOpening;
    });
  }

  Scene& scene_;
  const std::function<double()>& draw_;
};

/// Puts an arc of at most half a circle in the place of a part of side i.
void splice(SceneRoom& room, std::size_t i, const Vec2& from, const Vec2& through, const Vec2& to,
            SceneArc arc) {
  const double angle = 2 * std::asin(std::min(1.0, (to - from).norm() / 2 / arc.radius));
  const int chords = fine_chords(arc.radius, angle);
  Polygon2 corners{from};
  for (const Vec2& p : arc_points(from, through, to, chords)) corners.push_back(p);
  room.polygon.insert(room.polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1, corners.begin(),
                      corners.end());
  arc.from = arc.bulges ? from : to;
  arc.to = arc.bulges ? to : from;
  room.arcs.push_back(arc);
}

/// The room whose wall runs along all of the bay, or -1 = none at all, or -2 = something else is there.
int ArcMaker::room_behind(std::size_t r, const Bay& bay, const Side& side) const {
  int found = -1;
  for (std::size_t i = 0; i < scene_.rooms.size(); ++i) {
    const SceneRoom& other = scene_.rooms[i];
    if (i == r || other.storey != scene_.rooms[r].storey) continue;
    for (int k = -2; k <= 2; ++k) {
      const Vec2 p = bay.middle + 0.5 * k * (bay.half + kCorner) * side.along() + kThickest * side.outwards();
      if (!contains(other.polygon, p) && border_distance(other.polygon, p) > kOutside) continue;
      if (found >= 0 && found != static_cast<int>(i)) return -2;
      found = static_cast<int>(i);
    }
  }
  return found;
}

void ArcMaker::add_bay(std::size_t r) {
  const auto i = long_side(r, kLeastChord + 2 * kCorner);
  if (!i) return;
  SceneRoom& room = scene_.rooms[r];
  const Side side = side_of(room.polygon, *i);
  Bay bay{*i, {0, 0}, 0, {0, 0}, {0, 0}, 0};
  bay.half = draw(kLeastChord, std::min(side.length() - 2 * kCorner, 6.0)) / 2;
  const double height = draw(0.12, 0.5) * 2 * bay.half;
  bay.middle = side.from + draw(kCorner + bay.half, side.length() - kCorner - bay.half) * side.along();
  bay.apex = bay.middle + height * side.outwards();
  bay.radius = (bay.half * bay.half + height * height) / (2 * height);
  bay.centre = bay.apex - bay.radius * side.outwards();
  const int behind = room_behind(r, bay, side);
  if (behind == -2) return;
  if (behind == -1) clear_windows(r, bay.middle, bay.half);
  if (opens_near(bay.middle, bay.half)) return;
  for (int k = -8; k <= 8; ++k) {
    const double angle = k / 8.0 * std::asin(std::min(1.0, bay.half / bay.radius));
    const Vec2 radial = std::cos(angle) * side.outwards() + std::sin(angle) * side.along();
    if (clearance(r, behind, bay.centre + bay.radius * radial) < kOutside) return;
  }
  if (behind >= 0 && !reach_into(bay, side, static_cast<std::size_t>(behind))) return;
  splice(room, bay.side, bay.middle - bay.half * side.along(), bay.apex, bay.middle + bay.half * side.along(),
         {bay.centre, bay.radius, {}, {}, true});
}

/// Gives the room behind the wall its side of the bay, as thick as the wall; false when there is no room.
bool ArcMaker::reach_into(const Bay& bay, const Side& side, std::size_t behind) {
  SceneRoom& room = scene_.rooms[behind];
  if (has_shaft(behind)) return false;
  for (std::size_t j = 0; j < room.polygon.size(); ++j) {
    const Side other = side_of(room.polygon, j);
    const double wall = (other.from - bay.middle).dot(side.outwards());
    if (other.length() < kStraight || other.along().dot(side.along()) > -0.9999999 || wall < 0.03 ||
        wall > kThickest) {
      continue;
    }
    const double radius = bay.radius + wall;
    const double above = wall - (bay.centre - bay.middle).dot(side.outwards());  // of the centre
    const double half = std::sqrt(radius * radius - above * above);
    const Vec2 foot = bay.middle + wall * side.outwards();
    const Vec2 from = foot + half * side.along();
    const Vec2 to = foot - half * side.along();
    const Vec2 apex = bay.centre + radius * side.outwards();
    const double before = (from - other.from).dot(other.along());
    const double after = (other.to - to).dot(other.along());
    if (before < kCorner || after < kCorner || opens_near(foot, half)) continue;
    bool fits = true;
    for (const Vec2& p : arc_points(from, apex, to, 12)) {
      for (std::size_t k = 0; k < room.polygon.size(); ++k) {
        const double least = distance(other, p) < kCorner ? kCorner : kPassage;
        fits = fits && (k == j || distance(side_of(room.polygon, k), p) >= least);
      }
      fits = fits && (contains(room.polygon, p) || distance(other, p) < 1e-6);
    }
    if (!fits) continue;
    splice(room, j, from, apex, to, {bay.centre, radius, {}, {}, false});
    return true;
  }
  return false;
}

void ArcMaker::round_corner(std::size_t r) {
  SceneRoom& room = scene_.rooms[r];
  const std::size_t n = room.polygon.size();
  if (has_shaft(r)) return;
  const auto first = static_cast<std::size_t>(draw_() * static_cast<double>(n));
  const double radius = draw(0.4, 1.6);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (first + k) % n;
    const Side in = side_of(room.polygon, i);
    const Side out = side_of(room.polygon, (i + 1) % n);
    const double turn = std::atan2(in.along().x() * out.along().y() - in.along().y() * out.along().x(),
                                   in.along().dot(out.along()));
    if (turn < 0.5 || turn > 2.2) continue;
    const double tangent = radius * std::tan(turn / 2);
    const double room_for = std::min(in.length(), out.length()) - kCorner;
    if (tangent > room_for || opens_near(in.to, tangent)) continue;
    const Vec2 from = in.to - tangent * in.along();
    const Vec2 to = in.to + tangent * out.along();
    const Vec2 centre = from - radius * in.outwards();
    const Vec2 through = centre + radius * (in.to - centre).normalized();
    room.polygon.erase(room.polygon.begin() + static_cast<std::ptrdiff_t>((i + 1) % n));
    splice(room, i + 1 == n ? n - 2 : i, from, through, to, {centre, radius, {}, {}, true});
    return;
  }
}

void ArcMaker::add_tower(std::size_t r) {
  const double radius = draw(1.4, 3.0);
  const auto i = long_side(r, 2.4);
  if (!i) return;
  const Side side = side_of(scene_.rooms[r].polygon, *i);
  const Vec2 middle = 0.5 * (side.from + side.to);
  const Vec2 centre = middle + (kTowerWall + radius) * side.outwards();
  if (clearance(r, -1, centre) < radius + kOutside ||
      border_distance(scene_.rooms[r].polygon, centre) < radius + kTowerWall - 1e-6) {
    return;
  }
  clear_windows(r, middle, 0.6);
  if (opens_near(middle, 0.6)) return;
  const SceneRoom& room = scene_.rooms[r];
  SceneRoom tower;
  tower.name = room.name + "_tower";
  tower.storey = room.storey;
  tower.floor = room.floor;
  tower.ceiling = room.ceiling;
  const int chords = fine_chords(radius, 2 * std::numbers::pi);
  for (int k = 0; k < chords; ++k) {
    const double angle = 2 * std::numbers::pi * k / chords;
    tower.polygon.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  tower.arcs.push_back({centre, radius, tower.polygon[0], tower.polygon[0], true});
  SceneDoor door;
  door.room_a = static_cast<int>(r);
  door.room_b = static_cast<int>(scene_.rooms.size());
  door.at = middle;
  door.height = std::min(2.05, room.ceiling - room.floor - 0.1);
  scene_.rooms.push_back(tower);
  scene_.doors.push_back(door);
}

}  // namespace

void add_arcs(Scene& scene, const std::function<double()>& draw) {
  ArcMaker(scene, draw).make();
}

}  // namespace roomcut::synthesize

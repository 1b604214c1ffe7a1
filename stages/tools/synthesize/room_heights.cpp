// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/room_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "stages/tools/synthesize/plan.h"

namespace roomcut::synthesize {

namespace {

constexpr double kOnLevel = 1e-6;  // slopes this close to the level one do not need it [m]

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// What all floors and ceilings of the room are, the level ones as slopes of none.
std::vector<SceneSlope> all_surfaces(const SceneRoom& room) {
  std::vector<SceneSlope> all = room.slopes;
  if (room.level_floor) all.push_back({false, {0, 0}, room.floor, {}});
  if (room.level_ceiling) all.push_back({true, {0, 0}, room.ceiling, {}});
  return all;
}

/// The parts inside the polygon of the line gradient · p + c = 0.
std::vector<std::array<Vec2, 2>> inside(const Polygon2& polygon, const Vec2& gradient, double c) {
  std::vector<std::array<Vec2, 2>> parts;
  const double steep = gradient.norm();
  if (steep < 1e-9) return parts;
  const Vec2 normal = gradient / steep;
  const Vec2 along(-normal.y(), normal.x());
  const Vec2 foot = -c / steep * normal;
  std::vector<double> cuts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    const double da = (a - foot).dot(normal);
    const double db = (b - foot).dot(normal);
    if (std::max(da, db) < -kOnLevel || std::min(da, db) > kOnLevel) continue;
    if (std::abs(da) <= kOnLevel) cuts.push_back((a - foot).dot(along));
    if (da * db < 0) cuts.push_back((a + da / (da - db) * (b - a) - foot).dot(along));
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] - cuts[i] > kOnLevel && contains(polygon, foot + 0.5 * (cuts[i] + cuts[i + 1]) * along)) {
      parts.push_back({foot + cuts[i] * along, foot + cuts[i + 1] * along});
    }
  }
  return parts;
}

/// Highest place of the ceilings that are everywhere, or lowest of such floors; none = infinite.
double extreme(const SceneRoom& room, bool ceiling) {
  SceneRoom covered = room;
  covered.level_floor = covered.level_ceiling = false;
  std::erase_if(covered.slopes,
                [&](const SceneSlope& s) { return s.ceiling != ceiling || !s.polygon.empty(); });
  const double sign = ceiling ? 1 : -1;
  if (covered.slopes.empty()) return sign * std::numeric_limits<double>::infinity();
  std::vector<Vec2> places = room.polygon;
  const auto lines = creases(covered);
  for (const auto& [a, b] : lines) {
    places.insert(places.end(), {a, b});
    for (const auto& [c, d] : lines) {
      const double det = cross(b - a, d - c);
      if (std::abs(det) > 1e-12) places.push_back(a + cross(c - a, d - c) / det * (b - a));
    }
  }
  double best = -std::numeric_limits<double>::infinity();
  for (const Vec2& p : places) {
    double least = std::numeric_limits<double>::infinity();
    for (const SceneSlope& slope : covered.slopes) least = std::min(least, sign * slope.height(p));
    const bool here = contains(room.polygon, p) || border_distance(room.polygon, p) < 1e-6;
    if (here) best = std::max(best, least);
  }
  return sign * best;
}

}  // namespace

int surface_at(const SceneRoom& room, const Vec2& p, bool ceiling) {
  int best = -1;
  const double sign = ceiling ? 1 : -1;
  const bool level = ceiling ? room.level_ceiling : room.level_floor;
  double height =
      level ? sign * (ceiling ? room.ceiling : room.floor) : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < room.slopes.size(); ++i) {
    const SceneSlope& slope = room.slopes[i];
    if (slope.ceiling != ceiling || (!slope.polygon.empty() && !contains(slope.polygon, p))) continue;
    if (sign * slope.height(p) < height) {
      height = sign * slope.height(p);
      best = static_cast<int>(i);
    }
  }
  return best;
}

double floor_at(const SceneRoom& room, const Vec2& p) {
  const int slope = surface_at(room, p, false);
  return slope < 0 ? room.floor : room.slopes[static_cast<std::size_t>(slope)].height(p);
}

double ceiling_at(const SceneRoom& room, const Vec2& p) {
  const int slope = surface_at(room, p, true);
  return slope < 0 ? room.ceiling : room.slopes[static_cast<std::size_t>(slope)].height(p);
}

std::vector<std::array<Vec2, 2>> creases(const SceneRoom& room) {
  std::vector<std::array<Vec2, 2>> lines;
  const std::vector<SceneSlope> all = all_surfaces(room);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      for (const auto& part : inside(room.polygon, all[i].gradient - all[j].gradient, all[i].c - all[j].c)) {
        lines.push_back(part);
      }
    }
  }
  return lines;
}

void settle_heights(SceneRoom& room) {
  const double highest = extreme(room, true);
  const double lowest = extreme(room, false);
  if (highest < room.ceiling + kOnLevel) {
    room.ceiling = highest;
    room.level_ceiling = false;
  }
  if (lowest > room.floor - kOnLevel) {
    room.floor = lowest;
    room.level_floor = false;
  }
}

SceneSlope sloped(bool ceiling, const Vec3& at, double pitch, double azimuth) {
  SceneSlope slope;
  slope.ceiling = ceiling;
  slope.gradient = -std::tan(pitch) * Vec2(std::cos(azimuth), std::sin(azimuth));
  slope.c = at.z() - slope.gradient.dot(at.head<2>());
  return slope;
}

std::vector<SceneSlope> roof(RoofKind kind, const Polygon2& footprint, double pitch, double azimuth,
                             double eaves) {
  std::vector<SceneSlope> planes;
  const int sides = kind == RoofKind::kHip ? 4 : kind == RoofKind::kGable ? 2 : 1;
  for (int i = 0; i < sides; ++i) {
    const double falls = azimuth + (i % 2) * std::numbers::pi + (i / 2) * std::numbers::pi / 2;
    const Vec2 direction(std::cos(falls), std::sin(falls));
    const Vec2 furthest =
        *std::max_element(footprint.begin(), footprint.end(),
                          [&](const Vec2& a, const Vec2& b) { return a.dot(direction) < b.dot(direction); });
    planes.push_back(sloped(true, {furthest.x(), furthest.y(), eaves}, pitch, falls));
  }
  return planes;
}

}  // namespace roomcut::synthesize

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/walls.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stages/tools/synthesize/room_heights.h"

namespace roomcut::synthesize {

namespace {

constexpr double kThickest = 0.6, kShortest = 0.2, kLowest = 0.5;  // [m]
constexpr double kParallel = 0.0175;                               // sine of the angle

/// The wall between the sides a0 -> a1 and b0 -> b1 of two rooms that lie left of their sides.
std::optional<Wall> wall_between(const Vec2& a0, const Vec2& a1, const Vec2& b0, const Vec2& b1) {
  const Vec2 u = (a1 - a0).normalized();
  const Vec2 outwards(u.y(), -u.x());
  const Vec2 other = (b1 - b0).normalized();
  if (u.dot(other) > 0 || std::abs(other.dot(outwards)) > kParallel) return std::nullopt;
  const double from = std::max(0.0, (b1 - a0).dot(u));
  const double to = std::min((a1 - a0).norm(), (b0 - a0).dot(u));
  const double thickness = (0.5 * (b0 + b1) - a0).dot(outwards);
  if (to - from < kShortest || thickness <= 0 || thickness > kThickest) return std::nullopt;
  Wall wall;
  wall.a = a0 + from * u + thickness / 2 * outwards;
  wall.b = a0 + to * u + thickness / 2 * outwards;
  wall.thickness = thickness;
  return wall;
}

void add_walls(const Scene& scene, std::size_t i, std::size_t j, std::vector<Wall>& walls) {
  const SceneRoom& a = scene.rooms[i];
  const SceneRoom& b = scene.rooms[j];
  if (std::min(a.ceiling, b.ceiling) - std::max(a.floor, b.floor) < kLowest) return;
  for (std::size_t s = 0; s < a.polygon.size(); ++s) {
    for (std::size_t t = 0; t < b.polygon.size(); ++t) {
      auto wall = wall_between(a.polygon[s], a.polygon[(s + 1) % a.polygon.size()], b.polygon[t],
                               b.polygon[(t + 1) % b.polygon.size()]);
      if (!wall) continue;
      // At its lowest place: beside both rooms all along.
      double z0 = std::max(a.floor, b.floor);
      double z1 = std::min(a.ceiling, b.ceiling);
      for (const Vec2& p : {wall->a, wall->b}) {
        z0 = std::max({z0, floor_at(a, p), floor_at(b, p)});
        z1 = std::min({z1, ceiling_at(a, p), ceiling_at(b, p)});
      }
      if (z1 - z0 < kLowest) continue;
      wall->room_a = static_cast<int>(i);
      wall->room_b = static_cast<int>(j);
      wall->z0 = z0;
      wall->z1 = z1;
      walls.push_back(*wall);
    }
  }
}

}  // namespace

std::vector<Wall> find_walls(const Scene& scene) {
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < scene.rooms.size(); ++i) {
    for (std::size_t j = i + 1; j < scene.rooms.size(); ++j) add_walls(scene, i, j, walls);
  }
  return walls;
}

}  // namespace roomcut::synthesize

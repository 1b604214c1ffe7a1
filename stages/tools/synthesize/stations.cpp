// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/stations.h"

#include <algorithm>
#include <limits>

#include "stages/tools/synthesize/plan.h"
#include "stages/tools/synthesize/room_heights.h"

namespace roomcut::synthesize {

namespace {

constexpr double kReach = 6.0;                // a spot of floor is no further than this from a scanner [m]
constexpr double kRaster = 0.3;               // of candidate positions [m]
constexpr double kWallClearance = 0.4;        // [m]
constexpr double kFurnitureClearance = 0.25;  // [m]
constexpr double kCeilingClearance = 0.3;     // [m]

struct Spot {
  Vec2 p;
  double clearance;  ///< from the walls [m]
  bool usable;
};

/// Height of a scanner over p: eye height, or somewhat above the middle of a low room.
double scanner_height(const SceneRoom& room, double station_height, const Vec2& p) {
  const double floor = floor_at(room, p);
  const double ceiling = ceiling_at(room, p);
  return std::min(std::min(floor + station_height, 0.5 * (floor + ceiling) + 0.5), ceiling - 0.05);
}

/// From the walls and the columns.
double clearance_at(const SceneRoom& room, const Vec2& p) {
  double clearance = border_distance(room.polygon, p);
  for (const SceneColumn& column : room.columns) {
    clearance = contains(column.polygon, p) ? 0 : std::min(clearance, border_distance(column.polygon, p));
  }
  return clearance;
}

std::vector<Spot> floor_raster(const SceneRoom& room, const Building& building, double station_height) {
  Vec2 lo = room.polygon[0];
  Vec2 hi = lo;
  for (const Vec2& p : room.polygon) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  std::vector<Spot> spots;
  for (double y = lo.y() + kRaster / 2; y < hi.y(); y += kRaster) {
    for (double x = lo.x() + kRaster / 2; x < hi.x(); x += kRaster) {
      const Vec2 p(x, y);
      if (!contains(room.polygon, p)) continue;
      const double z = scanner_height(room, station_height, p);
      if (!room.level_ceiling && z > ceiling_at(room, p) - kCeilingClearance) continue;
      const double clearance = clearance_at(room, p);
      const bool free =
          std::none_of(building.furniture.begin(), building.furniture.end(), [&](const auto& box) {
            return box.z1 > room.floor && box.z0 < z + 0.3 && in_plan(box, p, kFurnitureClearance);
          });
      spots.push_back({p, clearance, free && clearance > kWallClearance});
    }
  }
  return spots;
}

/// Greedy: first the spot with most room around it, then the one furthest from all others.
std::vector<Vec2> choose(const SceneRoom& room, const std::vector<Spot>& spots) {
  std::vector<Vec2> chosen;
  std::vector<double> distance(spots.size(), std::numeric_limits<double>::infinity());
  while (true) {
    const Spot* best = nullptr;
    double best_score = -1;
    double furthest = 0;
    for (std::size_t i = 0; i < spots.size(); ++i) {
      furthest = std::max(furthest, distance[i]);
      const double score = chosen.empty() ? spots[i].clearance : distance[i];
      if (spots[i].usable && score > best_score) {
        best_score = score;
        best = &spots[i];
      }
    }
    if (!chosen.empty() && (furthest <= kReach || best == nullptr || best_score < kReach / 2)) return chosen;
    chosen.push_back(best != nullptr ? best->p : innermost_point(room.polygon));
    for (std::size_t i = 0; i < spots.size(); ++i) {
      distance[i] = std::min(distance[i], (spots[i].p - chosen.back()).norm());
    }
  }
}

}  // namespace

void place_stations(const Scene& scene, Building& building) {
  if (!scene.sampling.stations.empty()) {
    for (const Vec3& station : scene.sampling.stations) {
      building.stations.push_back(station);
      building.station_room.push_back(-1);
      for (std::size_t r = 0; r < scene.rooms.size(); ++r) {
        const SceneRoom& room = scene.rooms[r];
        if (station.z() > room.floor && station.z() < room.ceiling &&
            contains(room.polygon, station.head<2>())) {
          building.station_room.back() = static_cast<int>(r);
        }
      }
    }
    return;
  }
  for (std::size_t r = 0; r < scene.rooms.size(); ++r) {
    const SceneRoom& room = scene.rooms[r];
    if (!room.scanned) continue;
    const double height = scene.sampling.station_height;
    for (const Vec2& p : choose(room, floor_raster(room, building, height))) {
      building.stations.emplace_back(p.x(), p.y(), scanner_height(room, height, p));
      building.station_room.push_back(static_cast<int>(r));
    }
  }
}

}  // namespace roomcut::synthesize

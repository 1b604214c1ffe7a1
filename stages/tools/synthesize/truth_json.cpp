// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "common/artefact/json_values.h"
#include "stages/tools/synthesize/plan.h"
#include "stages/tools/synthesize/room_heights.h"
#include "stages/tools/synthesize/synthesize_io.h"
#include "stages/tools/synthesize/walls.h"

namespace roomcut::synthesize {

using nlohmann::json;

namespace {

double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}
json point(const Vec2& p) {
  return json::array({rounded(p.x()), rounded(p.y())});
}
json point(const Vec3& p) {
  return json::array({rounded(p.x()), rounded(p.y()), rounded(p.z())});
}

/// Of the room alone, without doorways and niches.
double room_volume(const SceneRoom& room) {
  if (room.slopes.empty() && room.columns.empty() && room.niches.empty()) {
    return doubled_area(room.polygon) / 2 * (room.ceiling - room.floor);
  }
  Scene alone;
  alone.rooms.push_back(room);
  std::erase_if(alone.rooms[0].niches, [](const SceneNiche& niche) { return niche.depth > 0; });
  return volume(make_truth(alone, place(alone)));
}

double room_area(const SceneRoom& room) {
  double area = doubled_area(room.polygon) / 2;
  for (const SceneColumn& column : room.columns) area -= doubled_area(column.polygon) / 2;
  for (const SceneNiche& niche : room.niches) area += std::min(niche.depth, 0.0) * niche.width;
  return area;
}

class TruthTables {
 public:
  TruthTables(const Scene& scene, const Building& building)
      : scene_(scene), building_(building), walls_(find_walls(scene)) {}

  void add_copy(std::uint64_t copy) {
    offset_ = copy_offset(scene_, building_, copy);
    suffix_ = copies(scene_) > 1 ? " #" + std::to_string(copy) : "";
    first_room_ = copy * scene_.rooms.size();
    storey_ = static_cast<int>(copy) / (scene_.repeat.x * scene_.repeat.y) *
              static_cast<int>(scene_.storeys.size());
    add_rooms();
    for (const WallOpening& door : building_.doors) doors.push_back(opening(door));
    for (const WallOpening& window : building_.windows) windows.push_back(opening(window));
    for (std::size_t i = 0; i < building_.stations.size(); ++i) {
      const int room = building_.station_room[i];
      stations.push_back(
          {{"position", point(Vec3(building_.stations[i] + offset_))},
           {"room", room < 0 ? json(nullptr) : json(first_room_ + static_cast<std::uint64_t>(room))}});
    }
    for (const Wall& wall : walls_) add_wall(wall);
    for (std::size_t i = 0; i < scene_.rooms.size(); ++i) {
      add_columns(i);
      add_arcs(i);
    }
    for (const PlacedNiche& niche : building_.niches) add_niche(niche);
  }

  json rooms = json::array(), doors = json::array(), windows = json::array(), stations = json::array(),
       walls = json::array(), columns = json::array(), arcs = json::array(), niches = json::array();

 private:
  Vec2 moved(const Vec2& p) const { return p + offset_.head<2>(); }

  void add_rooms() {
    for (std::size_t i = 0; i < scene_.rooms.size(); ++i) {
      const SceneRoom& room = scene_.rooms[i];
      const Vec2 inside = innermost_point(room.polygon);
      const double middle = 0.5 * (floor_at(room, inside) + ceiling_at(room, inside));
      rooms.push_back({{"id", first_room_ + i},
                       {"name", room.name + suffix_},
                       {"storey", storey_ + room.storey},
                       {"storey_name", scene_.storeys[static_cast<std::size_t>(room.storey)]},
                       {"floor", rounded(room.floor + offset_.z())},
                       {"ceiling", rounded(room.ceiling + offset_.z())},
                       {"area", rounded(room_area(room))},
                       {"volume", rounded(room_volume(room))},
                       {"center", point(Vec3(Vec3(inside.x(), inside.y(), middle) + offset_))},
                       {"scanned", room.scanned},
                       {"polygon", moved(room.polygon)}});
    }
  }

  json moved(const Polygon2& polygon) const {
    json corners = json::array();
    for (const Vec2& p : polygon) corners.push_back(point(moved(p)));
    return corners;
  }

  void add_columns(std::size_t index) {
    const SceneRoom& room = scene_.rooms[index];
    for (const SceneColumn& column : room.columns) {
      columns.push_back({{"room", first_room_ + index},
                         {"shape", column.round ? "round" : "rectangular"},
                         {"center", point(moved(column.centre))},
                         {"width", rounded(column.size_x)},
                         {"depth", rounded(column.size_y)},
                         {"polygon", moved(column.polygon)},
                         {"z0", rounded(floor_at(room, column.centre) + offset_.z())},
                         {"z1", rounded(ceiling_at(room, column.centre) + offset_.z())}});
    }
  }

  void add_arcs(std::size_t index) {
    const SceneRoom& room = scene_.rooms[index];
    for (const SceneArc& arc : room.arcs) {
      arcs.push_back({{"room", first_room_ + index},
                      {"center", point(moved(arc.centre))},
                      {"radius", rounded(arc.radius)},
                      {"from", point(moved(arc.from))},
                      {"to", point(moved(arc.to))},
                      {"bulges", arc.bulges},
                      {"z0", rounded(room.floor + offset_.z())},
                      {"z1", rounded(room.ceiling + offset_.z())}});
    }
  }

  void add_niche(const PlacedNiche& niche) {
    niches.push_back({{"room", first_room_ + static_cast<std::uint64_t>(niche.room)},
                      {"pilaster", niche.solid},
                      {"width", rounded(niche.width)},
                      {"depth", rounded(niche.depth)},
                      {"polygon", moved(niche.polygon)},
                      {"z0", rounded(niche.z0 + offset_.z())},
                      {"z1", rounded(niche.z1 + offset_.z())}});
  }

  json opening(const WallOpening& o) const {
    json value = {{"center", point(moved(o.centre))},
                  {"along", point(o.right)},
                  {"width", rounded(o.width)},
                  {"z0", rounded(o.z0 + offset_.z())},
                  {"z1", rounded(o.z1 + offset_.z())},
                  {"depth", rounded(o.depth)},
                  {"rooms", json::array({first_room_ + static_cast<std::uint64_t>(o.room_a)})}};
    if (o.room_b >= 0) value["rooms"].push_back(first_room_ + static_cast<std::uint64_t>(o.room_b));
    return value;
  }

  void add_wall(const Wall& wall) {
    walls.push_back({{"rooms", json::array({first_room_ + static_cast<std::uint64_t>(wall.room_a),
                                            first_room_ + static_cast<std::uint64_t>(wall.room_b)})},
                     {"a", point(moved(wall.a))},
                     {"b", point(moved(wall.b))},
                     {"thickness", rounded(wall.thickness)},
                     {"z0", rounded(wall.z0 + offset_.z())},
                     {"z1", rounded(wall.z1 + offset_.z())}});
  }

  const Scene& scene_;
  const Building& building_;
  std::vector<Wall> walls_;
  Vec3 offset_{0, 0, 0};
  std::string suffix_;
  std::uint64_t first_room_ = 0;
  int storey_ = 0;
};

}  // namespace

json truth_json(const Scene& scene, const Building& building, const TriangleMesh& truth,
                std::uint64_t points) {
  TruthTables tables(scene, building);
  for (std::uint64_t copy = 0; copy < copies(scene); ++copy) tables.add_copy(copy);
  const Vec3 hi = building.hi + copy_offset(scene, building, copies(scene) - 1);
  const auto n = static_cast<double>(copies(scene));
  return {{"building", scene.name},
          {"seed", scene.seed},
          {"noise_m", scene.noise_m},
          {"points", points},
          {"sampling", scene.sampling.kind == SamplingKind::kTripod ? "tripod" : "uniform"},
          {"volume", rounded(n * volume(truth))},
          {"surface_area", rounded(n * surface_area(truth))},
          {"bbox", json::array({point(building.lo), point(hi)})},
          {"rooms", tables.rooms},
          {"doors", tables.doors},
          {"windows", tables.windows},
          {"walls", tables.walls},
          {"columns", tables.columns},
          {"niches", tables.niches},
          {"arcs", tables.arcs},
          {"stations", scene.sampling.kind == SamplingKind::kTripod ? tables.stations : json::array()}};
}

void write_truth_json(const std::filesystem::path& path, const Scene& scene, const Building& building,
                      const TriangleMesh& truth, std::uint64_t points, const Provenance& provenance) {
  write_json_artefact(path, artefacts::kScene, provenance, Frame{},
                      truth_json(scene, building, truth, points));
}

}  // namespace roomcut::synthesize

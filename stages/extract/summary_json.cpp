// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "common/artefact/json_values.h"
#include "common/geometry/scan_coordinates.h"
#include "stages/extract/model_files.h"

namespace roomcut::extract {

namespace {

/// In the scan's coordinates; heights are those at the space's centre.
Json space_json(const Space& space, const ScanCoordinates& scan) {
  const Vec3 floor = scan.to_scan(Vec3(space.centre.x(), space.centre.y(), space.floor_z));
  return {{"centre_m", {floor.x(), floor.y()}},
          {"floor_z_m", floor.z()},
          {"ceiling_z_m", scan.height_to_scan(space.centre, space.ceiling_z)},
          {"lowest_ceiling_z_m", scan.height_to_scan(space.centre, space.lowest_ceiling_z)},
          {"highest_ceiling_z_m", scan.height_to_scan(space.centre, space.highest_ceiling_z)},
          {"height_m", space.height()},
          {"area_m2", space.area_m2},
          {"volume_m3", space.volume_m3},
          {"unobserved_m3", space.unobserved_m3}};
}

std::string percent(double share) {
  return std::to_string(std::lround(100 * share)) + " %";
}

std::string why(const UnknownSpace& space) {
  const std::string evidence = percent(space.seen_inside) + " of what lies around it seen from inside, " +
                               percent(space.closed) + " closed all around";
  return (space.is_closed() ? "a room that nobody entered, or structure: " : "a room, or open air: ") +
         evidence;
}

std::string to_know(const UnknownSpace& space) {
  if (space.beside.empty()) {
    return "scan from inside it";
  }
  return "scan from inside it; it lies beside room " + std::to_string(space.beside.front().room);
}

Json unknown_json(const UnknownSpace& space, const ScanCoordinates& scan) {
  Json json = space_json(space.measures, scan);
  const Vec3 place = scan.to_scan(Vec3(space.place.x(), space.place.y(), space.measures.floor_z));
  json["storey"] = space.measures.storey;
  json["place_m"] = {place.x(), place.y(), place.z()};
  json["seen_inside"] = space.seen_inside;
  json["closed"] = space.closed;
  json["probability_empty"] = space.probability;
  json["beside"] = Json::array();
  for (const SharedWall& wall : space.beside) {
    json["beside"].push_back({{"room", wall.room}, {"wall_m2", wall.area_m2}});
  }
  json["why"] = why(space);
  json["to_know"] = to_know(space);
  return json;
}

Json opening_json(const ModelOpening& item, const ScanCoordinates& scan) {
  const Opening& opening = item.opening;
  const Vec2 middle = 0.5 * (opening.jamb_a + opening.jamb_b);
  const Vec3 sill = scan.to_scan(Vec3(middle.x(), middle.y(), opening.sill_z));
  return {{"opening_id", opening.id},
          {"storey", item.storey},
          {"rooms", {item.room_a, item.room_b}},
          {"centre_m", {sill.x(), sill.y()}},
          {"width_m", opening.width()},
          {"height_m", opening.height()},
          {"sill_z_m", sill.z()},
          {"thickness_m", opening.thickness_m},
          {"volume_m3", item.volume_m3}};
}

Json curved_json(const CurvedWall& wall, const ScanCoordinates& scan) {
  const Vec2 centre = scan.plan_to_scan(wall.centre);
  const Vec2 x = scan.plan_turn() * Vec2(1, 0);
  const double turn = std::atan2(x.y(), x.x());  // of a levelled scan's plan
  constexpr double kDegrees = 180 / std::numbers::pi;
  return {{"arc_id", wall.id},
          {"centre_m", {centre.x(), centre.y()}},
          {"radius_m", wall.radius_m},
          {"from_deg", kDegrees * (wall.from + turn)},
          {"to_deg", kDegrees * (wall.to + turn)},
          {"z0_m", scan.height_to_scan(wall.centre, wall.z0)},
          {"z1_m", scan.height_to_scan(wall.centre, wall.z1)},
          {"area_m2", wall.area_m2},
          {"storeys", wall.storeys},
          {"wall_ids", wall.wall_ids}};
}

Json check_json(const Model& model) {
  const MeshCheck& check = model.check;
  return {{"closed", check.closed()},
          {"oriented", check.oriented()},
          {"manifold", check.manifold()},
          {"self_intersections", check.self_intersections},
          {"degenerate_triangles", check.degenerate_triangles},
          {"components", check.components},
          {"euler", check.euler},
          {"volume_m3", check.volume_m3},
          {"cells_m3", model.empty_m3}};
}

Json summary_json(const Model& model, const CellComplex& complex, const Labels& labels) {
  const ScanCoordinates scan(complex.frame);
  Json storeys = Json::array();
  for (std::size_t i = 0; i < model.storeys.size(); ++i) {
    Json storey = space_json(model.storeys[i], scan);
    storey["storey"] = i;
    storey["rooms"] = std::count_if(model.rooms.begin(), model.rooms.end(),
                                    [i](const Space& room) { return room.storey == static_cast<int>(i); });
    storeys.push_back(std::move(storey));
  }
  Json rooms = Json::array();
  for (const Space& space : model.rooms) {
    Json room = space_json(space, scan);
    room["room"] = rooms.size();
    room["storey"] = space.storey;
    rooms.push_back(std::move(room));
  }
  Json unknown = Json::array();
  double unknown_m3 = 0;
  for (const UnknownSpace& space : model.unknown_spaces) {
    Json item = unknown_json(space, scan);
    item["unknown_space"] = unknown.size();
    unknown.push_back(std::move(item));
    unknown_m3 += space.measures.volume_m3;
  }
  Json openings = Json::array();
  for (const ModelOpening& opening : model.openings) {
    openings.push_back(opening_json(opening, scan));
  }
  Json curved = Json::array();
  for (const CurvedWall& wall : model.curved_walls) {
    curved.push_back(curved_json(wall, scan));
  }
  const double area = std::accumulate(model.storeys.begin(), model.storeys.end(), 0.0,
                                      [](double sum, const Space& storey) { return sum + storey.area_m2; });
  std::size_t polygons = 0;
  for (const SurfaceRegion& region : model.surface.regions) {
    polygons += region.polygons.size();
  }
  return {
      {"storeys", storeys},
      {"rooms", rooms},
      {"unknown_spaces", unknown},
      {"openings", openings},
      {"curved_walls", curved},
      {"totals",
       {{"area_m2", area},
        {"volume_m3", model.empty_m3},
        {"floor_m2", model.areas.floor},
        {"ceiling_m2", model.areas.ceiling},
        {"wall_m2", model.areas.wall},
        {"unknown_m3", unknown_m3},
        {"unobserved_empty_m3", model.unobserved_empty_m3},
        {"unobserved_solid_m3", model.unobserved_solid_m3}}},
      {"energy",
       {{"total_m3", labels.energy_m3}, {"data_m3", labels.data_m3}, {"boundary_m3", labels.boundary_m3}}},
      {"counts",
       {{"lines", complex.lines.size()},
        {"levels", complex.levels.size()},
        {"plan_faces", complex.faces()},
        {"cells", complex.cells()},
        {"surfaces", model.surface.regions.size()},
        {"polygons", polygons},
        {"triangles", model.surface.mesh.triangles.size()},
        {"vertices", model.surface.mesh.vertices.size()}}},
      {"mesh", check_json(model)}};
}

}  // namespace

bool write_summary(const std::filesystem::path& path, const Model& model, const CellComplex& complex,
                   const Labels& labels, const Provenance& provenance) {
  return write_json_artefact(path, artefacts::kSummary, provenance, complex.frame,
                             summary_json(model, complex, labels));
}

}  // namespace roomcut::extract

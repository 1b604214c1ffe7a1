// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/scene_json.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>

#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"
#include "stages/tools/synthesize/elements.h"
#include "stages/tools/synthesize/families.h"
#include "stages/tools/synthesize/plan.h"
#include "stages/tools/synthesize/room_heights.h"
#include "stages/tools/synthesize/room_json.h"
#include "stages/tools/synthesize/scene_limits.h"
#include "stages/tools/synthesize/scene_reader.h"

namespace roomcut::synthesize {

using nlohmann::json;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

class SceneParser {
 public:
  explicit SceneParser(std::string where) : where_(std::move(where)) {}
  Scene parse(const json& root);

 private:
  void parse_storey(const json& value, const std::string& path);
  void parse_room(const json& value, const std::string& path, double floor, double ceiling);
  void parse_door(const json& value, const std::string& path);
  void parse_window(const json& value, const std::string& path);
  void parse_furniture(const json& value, const std::string& path);
  void parse_shaft(const json& value, const std::string& path);
  void parse_sampling(const json& value, const std::string& path);
  void parse_handheld(const json& value, const std::string& path);
  void parse_repeat(const json& value, const std::string& path);
  void parse_random(const json& value, const std::string& path);
  std::vector<double> wall_halves(SceneNode& node, const std::vector<std::size_t>& side) const;
  int room_index(SceneNode& node, const json* name);
  int room_named(SceneNode& node, const std::string& key) { return room_index(node, node.member(key)); }
  std::pair<int, int> two_rooms(SceneNode& node);

  std::string where_;
  Scene scene_;
  double wall_m_ = 0.12;
  std::map<std::string, int> room_by_name_;
  std::vector<Problem> problems_;
};

Scene SceneParser::parse(const json& root) {
  {
    SceneNode node(root, where_ + ": scene", problems_);
    scene_.name = node.text("name", "scene");
    scene_.seed = static_cast<std::uint64_t>(node.integer("seed", 1, 0, INT64_MAX));
    scene_.noise_m = node.number("noise_m", 0.005, 0, 1);
    scene_.outliers = node.number("outliers", 0, 0, 0.9);
    scene_.holes = node.number("holes", 0, 0, 0.9);
    scene_.clutter_per_m2 = node.number("clutter_per_m2", 0, 0, 5);
    wall_m_ = node.number("wall_m", wall_m_, 0.001, 5);
    const auto each = [&](const char* key, void (SceneParser::*parse_one)(const json&, const std::string&)) {
      const json& items = node.list(key);
      for (std::size_t i = 0; i < items.size(); ++i) {
        (this->*parse_one)(items[i], node.path(key) + "[" + std::to_string(i) + "]");
      }
    };
    if (const json* value = node.member("random")) parse_random(*value, node.path("random"));
    each("storeys", &SceneParser::parse_storey);
    each("doors", &SceneParser::parse_door);
    each("windows", &SceneParser::parse_window);
    each("furniture", &SceneParser::parse_furniture);
    each("shafts", &SceneParser::parse_shaft);
    if (const json* value = node.member("sampling")) parse_sampling(*value, node.path("sampling"));
    if (const json* value = node.member("handheld")) parse_handheld(*value, node.path("handheld"));
    if (const json* value = node.member("repeat")) parse_repeat(*value, node.path("repeat"));
    if (scene_.rooms.empty() && problems_.empty()) node.problem("there is no room");
  }
  if (!problems_.empty()) refuse_scene(problems_);
  return scene_;
}

void SceneParser::parse_storey(const json& value, const std::string& path) {
  SceneNode node(value, path, problems_);
  scene_.storeys.push_back(node.text("name", "storey " + std::to_string(scene_.storeys.size())));
  const double floor = node.required_number("floor", -1e4, 1e4);
  const double ceiling = node.required_number("ceiling", -1e4, 1e4);
  const json& rooms = node.list("rooms");
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    parse_room(rooms[i], node.path("rooms") + "[" + std::to_string(i) + "]", floor, ceiling);
  }
}

void SceneParser::parse_room(const json& value, const std::string& path, double floor, double ceiling) {
  SceneNode node(value, path, problems_);
  SceneRoom room;
  room.name = node.text("name", "room " + std::to_string(scene_.rooms.size()));
  room.storey = static_cast<int>(scene_.storeys.size()) - 1;
  room.floor = node.number("floor", floor, -1e4, 1e4);
  room.ceiling = node.number("ceiling", ceiling, -1e4, 1e4);
  room.scanned = node.boolean("scanned", true);
  if (room.ceiling < room.floor + 0.1) node.problem("the ceiling is less than 0.1 m above the floor");
  if (node.has("outline") == node.has("polygon")) node.problem("needs either \"polygon\" or \"outline\"");
  std::vector<std::size_t> side;
  if (node.has("outline")) {
    const Polygon2 outline = node.polygon("outline", &side);
    const std::vector<double> half = wall_halves(node, side);
    if (outline.size() == half.size()) {
      try {
        room.polygon = inset(outline, half);
      } catch (const std::invalid_argument& error) {
        node.problem(error.what());
      }
    }
  } else {
    room.polygon = node.polygon("polygon", &side);
  }
  read_room_elements(node, room);
  if (!room.polygon.empty()) {
    room.arcs = arcs_of(room.polygon, side);
    settle_heights(room);
  }
  if (!room_by_name_.emplace(room.name, static_cast<int>(scene_.rooms.size())).second) {
    node.problem("a second room named \"" + shown(room.name) + "\"",
                 "room names are unique in the whole scene");
  }
  scene_.rooms.push_back(std::move(room));
}

/// Half the wall thickness of every side of an outline: `wall` is one number, or one per listed side.
std::vector<double> SceneParser::wall_halves(SceneNode& node, const std::vector<std::size_t>& side) const {
  std::vector<double> half;
  const json* wall = node.member("wall");
  const auto is_thickness = [](const json& w) { return w.is_number() && w > 0 && w < 5; };
  for (const std::size_t s : side) {
    if (wall == nullptr) {
      half.push_back(wall_m_ / 2);
    } else if (is_thickness(*wall)) {
      half.push_back(wall->get<double>() / 2);
    } else if (wall->is_array() && s < wall->size() && is_thickness((*wall)[s])) {
      half.push_back((*wall)[s].get<double>() / 2);
    } else {
      node.problem("\"wall\" must be a thickness in metres, or a list of one per side of the outline");
      return {};
    }
  }
  return half;
}

int SceneParser::room_index(SceneNode& node, const json* name) {
  if (name != nullptr && name->is_string()) {
    const auto found = room_by_name_.find(name->get<std::string>());
    if (found != room_by_name_.end()) return found->second;
    node.problem("there is no room named \"" + shown(name->get<std::string>()) + "\"");
  } else {
    node.problem("a room's name is missing");
  }
  return -1;
}

std::pair<int, int> SceneParser::two_rooms(SceneNode& node) {
  const json* between = node.member("between");
  if (between == nullptr || !between->is_array() || between->size() != 2) {
    node.problem("\"between\" must be the names of two rooms");
    return {-1, -1};
  }
  return {room_index(node, &(*between)[0]), room_index(node, &(*between)[1])};
}

void SceneParser::parse_door(const json& value, const std::string& path) {
  SceneNode node(value, path, problems_);
  SceneDoor door;
  std::tie(door.room_a, door.room_b) = two_rooms(node);
  door.at = node.point("at");
  door.width = node.number("width", door.width, 0.05, 50);
  door.height = node.number("height", door.height, 0.05, 50);
  door.sill = node.number("sill", door.sill, 0, 50);
  if (door.room_a >= 0 && door.room_b >= 0) scene_.doors.push_back(door);
}

void SceneParser::parse_window(const json& value, const std::string& path) {
  SceneNode node(value, path, problems_);
  SceneWindow window;
  window.room = room_named(node, "room");
  window.at = node.point("at");
  window.width = node.number("width", window.width, 0.05, 50);
  window.height = node.number("height", window.height, 0.05, 50);
  window.sill = node.number("sill", window.sill, 0, 50);
  window.depth = node.number("depth", window.depth, 0, 2);
  if (window.room >= 0) scene_.windows.push_back(window);
}

void SceneParser::parse_furniture(const json& value, const std::string& path) {
  SceneNode node(value, path, problems_);
  SceneFurniture box;
  const int room = room_named(node, "room");
  box.centre = node.point("at");
  box.size_x = node.required_number("width", 0.01, 100);
  box.size_y = node.required_number("depth", 0.01, 100);
  const double height = node.required_number("height", 0.01, 100);
  const double above = node.number("above_floor", 0, 0, 100);
  box.rotation = node.number("rotation_deg", 0, -360, 360) * kDegree;
  if (room < 0) return;
  box.z0 = scene_.rooms[room].floor + above;
  box.z1 = box.z0 + height;
  scene_.furniture.push_back(box);
}

void SceneParser::parse_shaft(const json& value, const std::string& path) {
  SceneNode node(value, path, problems_);
  SceneShaft shaft;
  std::tie(shaft.lower, shaft.upper) = two_rooms(node);
  shaft.polygon = node.polygon("polygon");
  if (shaft.lower >= 0 && shaft.upper >= 0 && !shaft.polygon.empty()) scene_.shafts.push_back(shaft);
}

void SceneParser::parse_sampling(const json& value, const std::string& path) {
  SceneNode node(value, path, problems_);
  Sampling& sampling = scene_.sampling;
  const std::string kind = node.choice("kind", "uniform", {"uniform", "tripod"});
  sampling.kind = kind == "tripod" ? SamplingKind::kTripod : SamplingKind::kUniform;
  sampling.points = static_cast<std::uint64_t>(node.integer("points", 1000000, 1, 10000000000));
  sampling.shuffled = node.choice("order", "surface", {"surface", "shuffled"}) == "shuffled";
  sampling.stations = node.points3("stations");
  sampling.station_height = node.number("station_height", sampling.station_height, 0.1, 10);
  sampling.blind_cone = node.number("blind_cone_deg", sampling.blind_cone / kDegree, 0, 90) * kDegree;
  sampling.max_range = node.number("max_range_m", sampling.max_range, 1, 1e4);
}

void SceneParser::parse_handheld(const json& value, const std::string& path) {
  SceneNode node(value, path, problems_);
  HandheldErrors& errors = scene_.handheld;
  errors.warp_m = node.number("warp_m", errors.warp_m, 0, 1);
  errors.correlation_m = node.number("correlation_m", errors.correlation_m, 0.1, 1000);
  errors.rounding_m = node.number("rounding_m", errors.rounding_m, 0, 0.5);
  errors.drift_m = node.number("drift_m", errors.drift_m, 0, 1);
}

void SceneParser::parse_repeat(const json& value, const std::string& path) {
  SceneNode node(value, path, problems_);
  scene_.repeat.x = static_cast<int>(node.integer("x", 1, 1, 1000));
  scene_.repeat.y = static_cast<int>(node.integer("y", 1, 1, 1000));
  scene_.repeat.storeys = static_cast<int>(node.integer("storeys", 1, 1, 1000));
  scene_.repeat.gap = node.number("gap_m", scene_.repeat.gap, 0.01, 100);
}

void SceneParser::parse_random(const json& value, const std::string& path) {
  SceneNode node(value, path, problems_);
  FamilySpec spec;
  spec.family = node.choice("family", spec.family, family_names());
  spec.seed = static_cast<std::uint64_t>(node.integer("seed", 1, 0, INT64_MAX));
  spec.storeys = static_cast<int>(node.integer("storeys", 0, 0, 20));
  spec.rooms = static_cast<int>(node.integer("rooms", 0, 0, 500));
  spec.doors = node.boolean("doors", true);
  spec.shafts = node.boolean("shafts", true);
  spec.unscanned = node.number("unscanned", 0, 0, 0.9);
  for (const json& element : node.list("elements")) {
    const auto& known = element_names();
    if (!element.is_string() || std::find(known.begin(), known.end(), element) == known.end()) {
      node.problem("\"elements\" must be a list of some of " + joined(known));
      continue;
    }
    spec.elements.push_back(element);
  }
  add_random_building(spec, scene_);
  for (std::size_t i = 0; i < scene_.rooms.size(); ++i)
    room_by_name_[scene_.rooms[i].name] = static_cast<int>(i);
}

}  // namespace

Scene scene_from_json(const json& root, const std::string& where) {
  return SceneParser(where).parse(root);
}

Scene read_scene(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw StageError(errors::kSceneUnreadable, path.string(), "cannot be read, or is not a file",
                     "give a scene file (schemas/scene.md)");
  }
  json root;
  try {
    root = parse_json(read_text_file(path));
  } catch (const BadJson& trouble) {
    throw StageError(errors::kSceneUnreadable, name, std::string("is not JSON: ") + trouble.what(),
                     "look at the place named: a missing or a trailing comma, an open bracket or quote?");
  }
  return scene_from_json(root, name);
}

}  // namespace roomcut::synthesize

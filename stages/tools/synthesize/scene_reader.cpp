// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/scene_reader.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/artefact/json_values.h"
#include "stages/tools/synthesize/column.h"
#include "stages/tools/synthesize/plan.h"
#include "stages/tools/synthesize/scene_limits.h"

namespace roomcut::synthesize {

using nlohmann::json;

namespace {

std::string range_text(double lowest, double highest) {
  return "must be a number in " + canonical_json(lowest) + " … " + canonical_json(highest);
}

bool is_point(const json& value, std::size_t size) {
  if (!value.is_array() || value.size() != size) return false;
  for (const json& x : value) {
    if (!x.is_number() || !(std::abs(x.get<double>()) <= 1e5)) return false;
  }
  return true;
}

Vec2 to_point(const json& value) {
  return {value[0].get<double>(), value[1].get<double>()};
}

/// Appends the chords of one `arc` member.
void append_arc(const json& arc, Polygon2& corners) {
  if (corners.empty()) throw std::invalid_argument("an arc needs a corner before it");
  if (!arc.is_object() || !arc.contains("through") || !arc.contains("to") || !is_point(arc["through"], 2) ||
      !is_point(arc["to"], 2)) {
    throw std::invalid_argument(R"(an arc is {"through": [x, y], "to": [x, y], "segments": n})");
  }
  const json segments = arc.value("segments", json(8));
  if (!segments.is_number_integer() || segments < 0 || segments > 1000) {
    throw std::invalid_argument("an arc has 1 … 1000 segments, or 0 for as many as it needs to be smooth");
  }
  const Vec2 from = corners.back();
  const Vec2 through = to_point(arc["through"]);
  const Vec2 to = to_point(arc["to"]);
  const int chords = segments.get<int>() > 0 ? segments.get<int>() : smooth_chords(from, through, to);
  for (const Vec2& p : arc_points(from, through, to, chords)) corners.push_back(p);
}

/// Drops a last corner that repeats the first, and turns the polygon counter-clockwise.
void normalise(Polygon2& corners, std::vector<std::size_t>& side) {
  if (corners.size() > 1 && (corners.front() - corners.back()).norm() < 1e-9) {
    corners.pop_back();
    side.pop_back();
  }
  if (corners.size() < 3) throw std::invalid_argument("a polygon needs three corners");
  if (corners.size() > scene_limits::kCorners) {
    throw std::invalid_argument("more than " + std::to_string(scene_limits::kCorners) + " corners");
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if ((corners[i] - corners[(i + 1) % corners.size()]).norm() < 1e-3) {
      throw std::invalid_argument("two neighbouring corners are less than 1 mm apart");
    }
  }
  if (self_intersects(corners)) throw std::invalid_argument("the polygon crosses or touches itself");
  if (doubled_area(corners) < 0) {
    std::reverse(corners.begin(), corners.end());
    std::reverse(side.begin(), side.end() - 1);  // side i runs from corner i to i + 1
  }
}

}  // namespace

SceneNode::SceneNode(const json& value, std::string path, std::vector<Problem>& problems)
    : value_(value), path_(std::move(path)), problems_(problems) {
  if (!value_.is_object()) problem("must be an object");
}

SceneNode::~SceneNode() {
  if (!value_.is_object()) return;
  for (const auto& [key, unused] : value_.items()) {
    if (!used_.contains(key) && key != "note")
      problem("unknown key \"" + shown(key) + "\"", "see schemas/scene.md");
  }
}

void SceneNode::problem(const std::string& what, const std::string& hint) {
  problems_.push_back({errors::kSceneInvalid, path_, what, hint.empty() ? kSceneRemedy : hint});
}

bool SceneNode::has(const std::string& key) const {
  return value_.is_object() && value_.contains(key);
}

const json* SceneNode::member(const std::string& key) {
  used_.insert(key);
  return has(key) ? &value_[key] : nullptr;
}

double SceneNode::number(const std::string& key, double fallback, double lowest, double highest) {
  const json* value = member(key);
  if (value == nullptr) return fallback;
  if (!value->is_number() || !(value->get<double>() >= lowest && value->get<double>() <= highest)) {
    problem("\"" + key + "\" " + range_text(lowest, highest));
    return fallback;
  }
  return value->get<double>();
}

double SceneNode::required_number(const std::string& key, double lowest, double highest) {
  if (member(key) == nullptr) problem("\"" + key + "\" is missing");
  return number(key, lowest, lowest, highest);
}

std::int64_t SceneNode::integer(const std::string& key, std::int64_t fallback, std::int64_t lowest,
                                std::int64_t highest) {
  const json* value = member(key);
  if (value == nullptr) return fallback;
  if (!value->is_number_integer() || *value < lowest || *value > highest) {
    problem("\"" + key + "\" must be a whole number in " + std::to_string(lowest) + " … " +
            std::to_string(highest));
    return fallback;
  }
  return value->get<std::int64_t>();
}

bool SceneNode::boolean(const std::string& key, bool fallback) {
  const json* value = member(key);
  if (value == nullptr) return fallback;
  if (!value->is_boolean()) problem("\"" + key + "\" must be true or false");
  return value->is_boolean() ? value->get<bool>() : fallback;
}

std::string SceneNode::text(const std::string& key, const std::string& fallback) {
  const json* value = member(key);
  if (value == nullptr) return fallback;
  const std::string content = value->is_string() ? value->get<std::string>() : "\n";
  const bool plain = std::none_of(content.begin(), content.end(), [](unsigned char c) { return c < ' '; });
  if (plain && content.size() <= scene_limits::kText) return content;
  problem("\"" + key + "\" must be text of one line, at most " + std::to_string(scene_limits::kText) +
          " characters");
  return fallback;
}

std::string SceneNode::choice(const std::string& key, const std::string& fallback,
                              const std::vector<std::string>& choices) {
  const std::string value = text(key, fallback);
  std::string all;
  for (const std::string& c : choices) {
    if (c == value) return value;
    all += (all.empty() ? "" : ", ") + c;
  }
  problem("\"" + key + "\" must be one of " + all);
  return fallback;
}

Vec2 SceneNode::point(const std::string& key) {
  const json* value = member(key);
  if (value != nullptr && is_point(*value, 2)) return to_point(*value);
  problem("\"" + key + "\" must be [x, y]");
  return {0, 0};
}

std::vector<Vec3> SceneNode::points3(const std::string& key) {
  std::vector<Vec3> points;
  for (const json& p : list(key)) {
    if (is_point(p, 3)) {
      points.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    } else {
      problem("\"" + key + "\" must be a list of [x, y, z]");
    }
  }
  return points;
}

Polygon2 SceneNode::polygon(const std::string& key, std::vector<std::size_t>* side_of_segment) {
  Polygon2 corners;
  std::vector<std::size_t> side;
  try {
    const json& items = list(key);
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (is_point(items[i], 2)) {
        corners.push_back(to_point(items[i]));
      } else if (items[i].is_object() && items[i].contains("arc")) {
        append_arc(items[i]["arc"], corners);
      } else {
        throw std::invalid_argument("corner " + std::to_string(i) + R"( must be [x, y] or {"arc": …})");
      }
      while (side.size() + 1 < corners.size()) side.push_back(i - 1);
    }
    side.push_back(items.size() - 1);
    normalise(corners, side);
  } catch (const std::invalid_argument& error) {
    problem("\"" + key + "\": " + error.what());
    corners.clear();
  }
  if (side_of_segment != nullptr) *side_of_segment = side;
  return corners;
}

const json& SceneNode::list(const std::string& key) {
  static const json kNone = json::array();
  const json* value = member(key);
  if (value == nullptr) return kNone;
  if (!value->is_array()) {
    problem("\"" + key + "\" must be a list");
    return kNone;
  }
  return *value;
}

}  // namespace roomcut::synthesize

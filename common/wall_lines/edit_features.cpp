// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "common/text/words.h"
#include "common/wall_lines/edit_document.h"
#include "common/wall_lines/edit_values.h"
#include "common/wall_lines/wall_lines_format.h"

namespace roomcut {

namespace {

/// A list as GDAL writes it into formats that have none: "(2:0,2)"; also "[0, 2]" and "0, 2".
Json list_from_text(std::string text) {
  text = std::string(trimmed(text));
  const bool ogr =
      !text.empty() && text.front() == '(' && text.back() == ')' && text.find(':') != std::string::npos;
  if (ogr) {
    text = text.substr(text.find(':') + 1);
    text.pop_back();
  }
  if (text.empty() || text.front() != '[') {
    text = "[" + text + "]";
  }
  return try_parse_json(text);
}

/// Indices of wall slices.
std::optional<std::vector<int>> levels_of(Json value) {
  if (value.is_string()) {
    value = list_from_text(value.get<std::string>());
  }
  if (!value.is_array() || value.empty()) {
    return std::nullopt;
  }
  std::vector<int> levels;
  for (const Json& item : value) {
    const std::optional<double> number = number_of(item);
    if (!number || *number < 0 || *number > 1e6 || *number != std::floor(*number)) {
      return std::nullopt;
    }
    levels.push_back(static_cast<int>(*number));
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

class FeatureReader {
 public:
  explicit FeatureReader(EditReport& report) : report_(report) {}

  std::vector<DrawnLine> read(const Json& feature, std::size_t index) {
    index_ = index;
    id_.clear();
    std::vector<DrawnLine> lines;
    if (!feature.is_object()) {
      problem(errors::kLinesGeometry, "is no feature", "delete it");
      return lines;
    }
    WallLine common;
    if (feature.contains("properties") && feature["properties"].is_object()) {
      read_properties(feature["properties"], common);
    }
    const std::vector<Vec2> points = read_geometry(feature);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      DrawnLine drawn{index, points.size() > 2 ? static_cast<int>(i) + 1 : 0, common};
      drawn.line.a = points[i];
      drawn.line.b = points[i + 1];
      lines.push_back(drawn);
    }
    return lines;
  }

 private:
  void problem(ErrorCode code, const std::string& what, const std::string& hint) {
    report_.problem(code, feature_place(index_, id_), what, hint);
  }
  void bad_property(const std::string& name, const Json& value, const std::string& wanted) {
    problem(errors::kLinesProperty, "property " + name + " is " + excerpt(value) + ", must be " + wanted,
            "correct it, or empty the field");
  }

  void read_properties(const Json& properties, WallLine& line) {
    if (properties.contains("wall_id")) {
      read_id(properties["wall_id"]);
    }
    line.id = id_;
    Json extra = Json::object();
    for (const auto& item : properties.items()) {
      if (!item.value().is_null()) {
        read_property(item.key(), item.value(), line, extra);
      }
    }
    line.extra_json = canonical_json(extra);
  }

  void read_id(const Json& value) {
    if (const std::optional<std::string> id = id_of(value)) {
      id_ = *id;
    } else {
      bad_property("wall_id", value, "a short text");
    }
  }

  void read_property(const std::string& name, const Json& value, WallLine& line, Json& extra) {
    if (name == "locked") {
      const std::optional<bool> locked = truth_of(value);
      locked ? void(line.locked = *locked) : bad_property(name, value, "true or false");
    } else if (name == "levels") {
      line.levels = levels_of(value);
      if (!line.levels) {
        bad_property(name, value, "a list of slice numbers, or null for all");
      }
    } else if (name == "note") {
      line.note = value.is_string() ? value.get<std::string>() : canonical_json(value);
    } else if (std::find(std::begin(kKnownProperties), std::end(kKnownProperties), name) ==
               std::end(kKnownProperties)) {
      if (name != "id" || value != id_) {  // some versions of QGIS copy the feature's id into a property
        extra[name] = value;
      }
    } else if (name != "wall_id" && name != "source" && !number_of(value)) {
      bad_property(name, value, "a number");
    }
  }

  std::vector<Vec2> read_geometry(const Json& feature) {
    const std::string remedy = "draw it as a line, or delete the feature";
    if (!feature.contains("geometry") || !feature["geometry"].is_object()) {
      problem(errors::kLinesGeometry, "has no geometry", remedy);
      return {};
    }
    const Json& geometry = feature["geometry"];
    const std::string type =
        geometry.contains("type") && geometry["type"].is_string() ? geometry["type"].get<std::string>() : "";
    const Json coordinates = geometry.contains("coordinates") ? geometry["coordinates"] : Json();
    if (type == "LineString") {
      return read_points(coordinates);
    }
    if (type == "MultiLineString" && coordinates.is_array() && coordinates.size() == 1) {
      return read_points(coordinates[0]);
    }
    problem(
        errors::kLinesGeometry,
        type == "MultiLineString"
            ? "is a MultiLineString of several parts"
            : "is a " + (type.empty() ? "geometry without type" : type) + ", not a LineString",
        type == "MultiLineString" ? "split it into single lines (QGIS: Multipart to singleparts)" : remedy);
    return {};
  }

  std::vector<Vec2> read_points(const Json& coordinates) {
    std::vector<Vec2> points;
    bool third = false;
    const std::size_t count = coordinates.is_array() ? coordinates.size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Json& point = coordinates[i];
      const bool pair = point.is_array() && point.size() >= 2;
      const std::optional<double> x = pair ? number_of(point[0]) : std::nullopt;
      const std::optional<double> y = pair ? number_of(point[1]) : std::nullopt;
      if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) {
        problem(errors::kLinesCoordinates,
                "point " + std::to_string(i) + " is " + excerpt(point) + ", must be two finite numbers",
                "write [x, y] in metres");
        return {};
      }
      third = third || point.size() > 2;
      points.push_back(rounded_point(Vec2(*x, *y)));
    }
    if (count < 2) {
      problem(errors::kLinesCoordinates, "has " + std::to_string(count) + " points, a line needs two",
              "draw the other end, or delete the feature");
      return {};
    }
    if (third) {
      report_.warn(feature_place(index_, id_), "heights are ignored: a wall line is seen from above");
    }
    return without_short_pieces(points);
  }

  static std::vector<Vec2> without_short_pieces(const std::vector<Vec2>& points) {
    std::vector<Vec2> kept{points.front()};
    for (const Vec2& point : points) {
      if ((point - kept.back()).norm() >= kShortestLine_m) {
        kept.push_back(point);
      }
    }
    if (kept.size() < 2) {
      kept.push_back(points.back());  // check_edit_extent() judges it, when it knows the file's unit
    }
    return kept;
  }

  EditReport& report_;
  std::size_t index_ = 0;
  std::string id_;
};

}  // namespace

std::string feature_place(std::size_t index, const std::string& id, const char* id_property) {
  const std::string place = "features[" + std::to_string(index) + "]";
  return id.empty() ? place : place + " (" + id_property + " " + id + ")";
}

std::vector<DrawnLine> read_edit_features(const Json& features, EditReport& report) {
  std::vector<DrawnLine> drawn;
  FeatureReader reader(report);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const std::vector<DrawnLine> lines = reader.read(features[i], i);
    drawn.insert(drawn.end(), lines.begin(), lines.end());
  }
  return drawn;
}

}  // namespace roomcut

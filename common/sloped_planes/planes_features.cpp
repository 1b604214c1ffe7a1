// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/sloped_planes/planes_features.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "common/geometry/convex_hull.h"
#include "common/sloped_planes/planes_format.h"
#include "common/wall_lines/edit_values.h"
#include "common/wall_lines/wall_lines_format.h"

namespace roomcut {

namespace {

constexpr double kDent = 1e-3;  ///< share of its hull that a ring may lack and pass for convex

class PlaneReader {
 public:
  PlaneReader(const Json& feature, std::size_t index, EditReport& report) : report_(report) {
    drawn_.feature = index;
    if (!feature.is_object()) {
      problem(errors::kLinesGeometry, "is no feature", "delete it");
      return;
    }
    if (feature.contains("properties") && feature["properties"].is_object()) {
      read_properties(feature["properties"]);
    }
    read_geometry(feature);
  }

  bool complete() const { return drawn_.outline.size() >= 3; }
  const DrawnPlane& drawn() const { return drawn_; }

 private:
  void problem(ErrorCode code, const std::string& what, const std::string& hint) {
    report_.problem(code, place_of(drawn_), what, hint);
  }
  void warn(const std::string& what) { report_.warn(place_of(drawn_), what); }
  void bad_property(const std::string& name, const Json& value, const std::string& wanted) {
    problem(errors::kLinesProperty, "property " + name + " is " + excerpt(value) + ", must be " + wanted,
            "correct it, or empty the field");
  }

  void read_properties(const Json& properties) {
    if (properties.contains(kPlanesEdit.id)) {
      const std::optional<std::string> id = id_of(properties[kPlanesEdit.id]);
      id ? void(drawn_.id = *id) : bad_property(kPlanesEdit.id, properties[kPlanesEdit.id], "a short text");
    }
    Json extra = Json::object();
    for (const auto& item : properties.items()) {
      const bool empty =
          item.value().is_null() || (item.value().is_string() && trimmed_text(item.value()).empty());
      if (!empty) {
        read_property(item.key(), item.value(), extra);
      }
    }
    drawn_.extra_json = canonical_json(extra);
  }

  void read_property(const std::string& name, const Json& value, Json& extra) {
    if (name == "pitch_deg") {
      read_number(name, value, 0, kSteepestPlane_deg, "from 0 to 87 degrees", drawn_.pitch_deg);
    } else if (name == "uphill_deg") {
      read_number(name, value, -360, 360, "from 0 to 360 degrees, counter-clockwise from x",
                  drawn_.uphill_deg);
    } else if (name == "height_m") {
      read_number(name, value, -1e9, 1e9, "a height in metres", drawn_.height_m);
    } else if (name == "side") {
      read_side(value);
    } else if (name == "locked") {
      const std::optional<bool> locked = truth_of(value);
      locked ? void(drawn_.locked = *locked) : bad_property(name, value, "true or false");
    } else if (name == "note") {
      drawn_.note = value.is_string() ? value.get<std::string>() : canonical_json(value);
    } else if (!is_plane_property(name)) {
      if (name != "id" || value != drawn_.id) {  // some versions of QGIS copy the feature's id
        extra[name] = value;
      }
    }
  }

  void read_number(const std::string& name, const Json& value, double low, double high,
                   const std::string& wanted, std::optional<double>& into) {
    const std::optional<double> number = number_of(value);
    if (!number || !(*number >= low && *number <= high)) {
      bad_property(name, value, "a number " + wanted);
    } else {
      into = rounded_coordinate(*number);
    }
  }

  void read_side(const Json& value) {
    std::string side = trimmed_text(value);
    std::transform(side.begin(), side.end(), side.begin(), [](unsigned char c) { return std::tolower(c); });
    if (side == kCeilingSide || side == kFloorSide) {
      drawn_.ceiling = side == kCeilingSide;
    } else {
      bad_property("side", value, "ceiling or floor");
    }
  }

  void read_geometry(const Json& feature) {
    const std::string remedy = "draw its outline as a polygon, or delete the feature";
    if (!feature.contains("geometry") || !feature["geometry"].is_object()) {
      problem(errors::kLinesGeometry, "has no geometry", remedy);
      return;
    }
    const Json& geometry = feature["geometry"];
    const std::string type =
        geometry.contains("type") && geometry["type"].is_string() ? geometry["type"].get<std::string>() : "";
    Json rings = geometry.contains("coordinates") ? geometry["coordinates"] : Json();
    const bool several = type == "MultiPolygon" && rings.is_array() && rings.size() > 1;
    if (several) {
      problem(errors::kLinesGeometry, "is a MultiPolygon of several parts",
              "split it into single polygons (QGIS: Multipart to singleparts)");
      return;
    }
    if (type == "MultiPolygon" && rings.is_array() && rings.size() == 1) {
      const Json only = rings[0];
      rings = only;
    } else if (type != "Polygon") {
      problem(errors::kLinesGeometry,
              "is a " + (type.empty() ? "geometry without type" : type) + ", not a Polygon", remedy);
      return;
    }
    if (rings.is_array() && rings.size() > 1) {
      warn("holes are ignored: an outline says where the plane lies, walls what is left out");
    }
    read_ring(rings.is_array() && !rings.empty() ? rings[0] : Json());
  }

  void read_ring(const Json& ring) {
    std::vector<Vec2> corners;
    bool third = false;
    for (std::size_t i = 0; ring.is_array() && i < ring.size(); ++i) {
      const Json& point = ring[i];
      const bool pair = point.is_array() && point.size() >= 2;
      const std::optional<double> x = pair ? number_of(point[0]) : std::nullopt;
      const std::optional<double> y = pair ? number_of(point[1]) : std::nullopt;
      if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) {
        problem(errors::kLinesCoordinates,
                "point " + std::to_string(i) + " is " + excerpt(point) + ", must be two finite numbers",
                "write [x, y] in metres");
        return;
      }
      third = third || point.size() > 2;
      corners.push_back(rounded_point(Vec2(*x, *y)));
    }
    const std::vector<Vec2> hull = convex_hull(corners);
    if (hull.size() < 3) {
      problem(
          errors::kLinesCoordinates,
          "has " + std::to_string(corners.size()) + " points that enclose nothing, an outline needs three",
          "draw its other corners, or delete the feature");
      return;
    }
    if (third) {
      warn("heights of corners are ignored: height_m, pitch_deg and uphill_deg say where the plane lies");
    }
    const double area = turned_area(hull);
    if (std::abs(turned_area(corners)) < (1 - kDent) * area) {
      warn("its outline is not convex; the plane is taken to lie over the convex hull of it");
    }
    drawn_.outline = hull;
  }

  EditReport& report_;
  DrawnPlane drawn_;
};

}  // namespace

std::vector<DrawnPlane> read_plane_features(const Json& features, EditReport& report) {
  std::vector<DrawnPlane> drawn;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const PlaneReader reader(features[i], i, report);
    if (reader.complete()) {
      drawn.push_back(reader.drawn());
    }
  }
  return drawn;
}

}  // namespace roomcut

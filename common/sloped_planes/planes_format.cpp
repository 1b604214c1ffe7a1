// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/sloped_planes/planes_format.h"

#include <algorithm>

#include "common/artefact/artefact_check.h"
#include "common/artefact/frame_crs.h"
#include "common/artefact/json_values.h"
#include "common/artefact/sha256.h"
#include "common/sloped_planes/planes_io.h"
#include "common/wall_lines/wall_lines_format.h"

namespace roomcut {

namespace {

Json point_json(const Vec2& local, const FilePlan& plan) {
  const Vec2 point = plan.to_file(local);
  return Json::array({point.x(), point.y()});
}

Json feature_json(const PlaneFeature& feature, const Frame& frame, const FilePlan& plan) {
  const PlaneNumbers numbers = numbers_of(feature.plane, frame);
  Json properties = parse_json(feature.extra_json);
  properties["plane_id"] = feature.id;
  properties["pitch_deg"] = numbers.pitch_deg;
  properties["uphill_deg"] = numbers.uphill_deg;
  properties["height_m"] = numbers.height_m;
  properties["side"] = feature.plane.ceiling ? kCeilingSide : kFloorSide;
  properties["source"] = source_name(feature.source);
  properties["locked"] = feature.locked;
  properties["area_m2"] = rounded_coordinate(feature.plane.area_m2);
  properties["rms_m"] = rounded_coordinate(feature.plane.rms_m);
  properties["note"] = feature.note.empty() ? Json() : Json(feature.note);
  Json ring = Json::array();
  for (const Vec2& corner : feature.plane.outline) {
    ring.push_back(point_json(corner, plan));
  }
  ring.push_back(ring.front());
  return {{"type", "Feature"},
          {"id", feature.id},
          {"properties", properties},
          {"geometry", {{"type", "Polygon"}, {"coordinates", Json::array({ring})}}}};
}

std::string features_text(const AcceptedPlanes& planes, const FilePlan& plan) {
  std::string text;
  for (const PlaneFeature& feature : planes.planes) {
    text += (text.empty() ? "" : ",\n") + canonical_json(feature_json(feature, planes.frame, plan));
  }
  return text;
}

std::string levels_text(const std::vector<Level>& levels) {
  Json list = Json::array();
  for (const Level& level : levels) {
    list.push_back({{"z", level.z}, {"cap", level.cap}, {"step", level.step}});
  }
  return canonical_json(list);
}

std::string box_text(const AcceptedPlanes& planes, const FilePlan& plan) {
  const Vec2 low = plan.to_file(planes.bbox_min);
  const Vec2 high = plan.to_file(planes.bbox_max);
  return canonical_json(Json::array({low.x(), low.y(), high.x(), high.y()}));
}

}  // namespace

bool is_plane_property(const std::string& name) {
  return std::find(std::begin(kPlaneProperties), std::end(kPlaneProperties), name) !=
         std::end(kPlaneProperties);
}

std::string planes_payload_sha256(const AcceptedPlanes& planes) {
  const AcceptedPlanes normalised = normalised_planes(planes);
  const FilePlan plan(normalised.frame, LineCoordinates::kScan);
  return sha256_hex(version_text(artefacts::kPlanes) + "\n" + canonical_json(to_json(normalised.frame)) +
                    "\n" + box_text(normalised, plan) + "\n" + levels_text(normalised.levels) + "\n" +
                    features_text(normalised, plan));
}

bool write_planes_file(const std::filesystem::path& path, const AcceptedPlanes& planes,
                       const Provenance& provenance) {
  const AcceptedPlanes normalised = normalised_planes(planes);
  const FilePlan plan(normalised.frame, LineCoordinates::kScan);
  Json made = to_json(provenance);
  made["payload_sha256"] = planes_payload_sha256(planes);
  std::string text = R"({
"type": "FeatureCollection",
"name": "planes",
"crs": {"type": "name", "properties": {"name": )";
  text.append(canonical_json(crs_of(normalised.frame))).append("}},\n\"").append(kMember).append("\": {\n");
  const auto member = [&text](const char* name, const std::string& value) {
    text.append("\"").append(name).append("\": ").append(value).append(",\n");
  };
  member("artefact", canonical_json(artefacts::kPlanes.name));
  member("schema_version", canonical_json(version_text(artefacts::kPlanes)));
  member("length_unit", canonical_json("m"));
  member(kCoordinatesKey, canonical_json(kScanCoordinates));
  member("frame", canonical_json(to_json(normalised.frame)));
  member("bbox", box_text(normalised, plan));
  member("levels", levels_text(normalised.levels));
  member("base_sha256", canonical_json(normalised.base_sha256));
  text.append("\"provenance\": ").append(canonical_json(made)).append("\n},\n\"features\": [\n");
  text.append(features_text(normalised, plan)).append("\n]\n}\n");
  return publish_json(path, text, made["payload_sha256"].get<std::string>());
}

}  // namespace roomcut

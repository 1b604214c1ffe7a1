// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "common/artefact/artefact_check.h"
#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"
#include "common/artefact/known_artefacts.h"
#include "common/artefact/limits.h"
#include "common/geometry/convex_hull.h"
#include "common/sloped_planes/planes_format.h"
#include "common/sloped_planes/planes_io.h"
#include "common/wall_lines/edit_values.h"
#include "common/wall_lines/wall_lines_format.h"

namespace roomcut {

namespace {

Vec2 point_from(const Json& x, const Json& y, const FilePlan& plan) {
  Vec2 local = plan.to_local({scan_metres(x), scan_metres(y)});
  if (!limits::is_local(local.x()) || !limits::is_local(local.y())) {
    throw BadJson("a point lies impossibly far from the frame's origin");
  }
  return local;
}

std::vector<Vec2> outline_from(const Json& geometry, const FilePlan& plan) {
  if (geometry.at("type") != "Polygon" || geometry.at("coordinates").size() != 1) {
    throw BadJson("the geometry is no Polygon of one ring");
  }
  std::vector<Vec2> corners;
  for (const Json& point : geometry.at("coordinates").at(0)) {
    corners.push_back(point_from(point.at(0), point.at(1), plan));
  }
  std::vector<Vec2> hull = convex_hull(corners);
  if (hull.size() < 3 || hull.size() + 1 != corners.size()) {
    throw BadJson("the outline is no convex ring");
  }
  return hull;
}

PlaneFeature plane_from(const Json& feature, const Frame& frame, const FilePlan& plan) {
  const Json& properties = feature.at("properties");
  const PlaneNumbers numbers{number_at(properties, "pitch_deg", 0, kSteepestPlane_deg),
                             number_at(properties, "uphill_deg", 0, 360),
                             scan_metres(properties.at("height_m"))};
  PlaneFeature result;
  result.id = properties.at("plane_id").get<std::string>();
  result.plane = plane_of(outline_from(feature.at("geometry"), plan), numbers, frame);
  const std::string side = properties.at("side").get<std::string>();
  if (side != kCeilingSide && side != kFloorSide) {
    throw BadJson("side is neither ceiling nor floor");
  }
  result.plane.ceiling = side == kCeilingSide;
  result.plane.area_m2 = number_at(properties, "area_m2", 0, limits::kLargestArea_m2);
  result.plane.rms_m = metres_at(properties, "rms_m");
  result.source = source_from_name(properties.at("source").get<std::string>());
  result.locked = properties.at("locked").get<bool>();
  if (!properties.at("note").is_null()) {
    result.note = properties.at("note").get<std::string>();
  }
  Json extra = Json::object();
  for (const auto& item : properties.items()) {
    if (!is_plane_property(item.key())) {
      extra[item.key()] = item.value();
    }
  }
  result.extra_json = canonical_json(extra);
  return result;
}

std::vector<Level> levels_from(const Json& list) {
  std::vector<Level> levels;
  for (const Json& item : list) {
    const double z = local_metres(item.at("z"));
    if (!levels.empty() && z <= levels.back().z) {
      throw BadJson("levels are not ascending");
    }
    levels.push_back({z, z, z, 0, 0, item.at("cap").get<bool>(), item.at("step").get<bool>()});
  }
  if (levels.size() < 2) {
    throw BadJson("has fewer than two levels");
  }
  return levels;
}

void read_features(const Json& features, AcceptedPlanes& content) {
  const FilePlan plan(content.frame, LineCoordinates::kScan);
  for (std::size_t i = 0; i < features.size(); ++i) {
    try {
      content.planes.push_back(plane_from(features.at(i), content.frame, plan));
    } catch (const Json::exception& error) {
      throw BadJson("features[" + std::to_string(i) + "]: " + short_message(error));
    } catch (const std::exception& error) {
      throw BadJson("features[" + std::to_string(i) + "]: " + error.what());
    }
    if (i > 0 && content.planes[i].id <= content.planes[i - 1].id) {
      throw BadJson("features[" + std::to_string(i) + "]: is not in the order of plane_id");
    }
  }
}

void read_member(const Json& member, PlanesFile& file) {
  if (member.at("length_unit") != "m" || member.at(kCoordinatesKey) != kScanCoordinates) {
    throw BadJson("is not in metres of the scan's own coordinates");
  }
  file.content.frame = frame_from_json(member.at("frame"));
  const FilePlan plan(file.content.frame, LineCoordinates::kScan);
  const Json& box = member.at("bbox");
  file.content.bbox_min = point_from(box.at(0), box.at(1), plan);
  file.content.bbox_max = point_from(box.at(2), box.at(3), plan);
  file.content.levels = levels_from(member.at("levels"));
  file.content.base_sha256 = member.at("base_sha256").get<std::string>();
  if (!file.content.base_sha256.empty() && !is_digest(file.content.base_sha256)) {  // no digest covers it
    throw BadJson("base_sha256 is no digest");
  }
  file.provenance = provenance_from_json(member.at("provenance"));
}

}  // namespace

PlanesFile read_planes_file(const std::filesystem::path& path) {
  PlanesFile file;
  InputRecord record{"", artefacts::kPlanes.name, "", "", ""};
  try {
    const Json document = parse_json(read_text_file(path));
    const Json& member = document.at(kMember);
    record.schema_version = member.at("schema_version").get<std::string>();
    check_type_and_version(path, member.at("artefact").get<std::string>(), record.schema_version,
                           artefacts::kPlanes);
    read_member(member, file);
    read_features(document.at("features"), file.content);
    record.payload_sha256 = member.at("provenance").at("payload_sha256").get<std::string>();
  } catch (const Json::exception& error) {
    throw_damaged(path, "", "not a planes artefact: " + short_message(error));
  } catch (const BadJson& error) {
    throw_damaged(path, "", error.what());
  }
  file.payload_sha256 = planes_payload_sha256(file.content);
  require_payload(path, record.payload_sha256, file.payload_sha256);
  require_params(path, file.provenance);
  remember_artefact(path, record);
  return file;
}

}  // namespace roomcut

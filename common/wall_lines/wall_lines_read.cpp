// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/artefact/artefact_check.h"
#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"
#include "common/artefact/known_artefacts.h"
#include "common/artefact/limits.h"
#include "common/errors/codes.h"
#include "common/wall_lines/edit_values.h"
#include "common/wall_lines/wall_lines_format.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut {

namespace {

constexpr double kDegToRad = std::numbers::pi / 180.0;
constexpr double kMostDegrees = 1e6;  ///< of a deviation: of a line that is not known at all
constexpr int kMostLevels = 1'000'000;

Vec2 point_from(const Json& x, const Json& y, const FilePlan& plan) {
  Vec2 local = plan.to_local({scan_metres(x), scan_metres(y)});
  if (!limits::is_local(local.x()) || !limits::is_local(local.y())) {
    throw BadJson("a point lies impossibly far from the frame's origin");
  }
  return local;
}

Vec2 point_from(const Json& value, const FilePlan& plan) {
  return point_from(value.at(0), value.at(1), plan);
}

/// Files of version 1.0 do not say it: theirs are local.
LineCoordinates coordinates_of(const Json& member) {
  const std::string text = member.value(kCoordinatesKey, std::string(kLocalCoordinates));
  if (text != kScanCoordinates && text != kLocalCoordinates) {
    throw BadJson("coordinates are neither those of the scan nor local");
  }
  return text == kScanCoordinates ? LineCoordinates::kScan : LineCoordinates::kLocal;
}

std::string unknown_properties(const Json& properties) {
  Json extra = Json::object();
  for (const auto& item : properties.items()) {
    const auto* end = std::end(kKnownProperties);
    if (std::find(std::begin(kKnownProperties), end, item.key()) == end) {
      extra[item.key()] = item.value();
    }
  }
  return canonical_json(extra);
}

WallLine line_from(const Json& feature, const FilePlan& plan) {
  const Json& geometry = feature.at("geometry");
  const Json& properties = feature.at("properties");
  if (geometry.at("type") != "LineString" || geometry.at("coordinates").size() != 2) {
    throw BadJson("the geometry is no LineString of two points");
  }
  WallLine line;
  line.id = properties.at("wall_id").get<std::string>();
  line.a = point_from(geometry.at("coordinates").at(0), plan);
  line.b = point_from(geometry.at("coordinates").at(1), plan);
  if (line.a == line.b) {
    throw BadJson("both ends are equal");
  }
  line.source = source_from_name(properties.at("source").get<std::string>());
  line.locked = properties.at("locked").get<bool>();
  if (!properties.at("levels").is_null()) {
    line.levels.emplace();
    for (const Json& level : properties.at("levels")) {
      line.levels->push_back(static_cast<int>(whole_number_in(level, 0, kMostLevels)));
    }
  }
  line.support_m = metres_at(properties, "support_m");
  line.rms_m = metres_at(properties, "rms_m");
  line.sigma_offset_m = metres_at(properties, "sigma_offset_m");
  line.sigma_angle_rad = number_at(properties, "sigma_angle_deg", 0, kMostDegrees) * kDegToRad;
  if (!properties.at("note").is_null()) {
    line.note = properties.at("note").get<std::string>();
  }
  line.extra_json = unknown_properties(properties);
  return line;
}

void read_member(const Json& member, LineCoordinates coordinates, WallLinesFile& file) {
  if (member.at("length_unit") != "m") {
    throw BadJson("length_unit is not m");
  }
  file.content.frame = frame_from_json(member.at("frame"));
  const FilePlan plan(file.content.frame, coordinates);
  const Json& box = member.at("bbox");
  file.content.bbox_min = point_from(box.at(0), box.at(1), plan);
  file.content.bbox_max = point_from(box.at(2), box.at(3), plan);
  file.content.base_sha256 = member.at("base_sha256").get<std::string>();
  const std::string& base = file.content.base_sha256;  // no digest covers it
  if (!base.empty() && !is_digest(base)) {
    throw BadJson("base_sha256 is no digest");
  }
  file.provenance = provenance_from_json(member.at("provenance"));
}

void read_features(const Json& features, const FilePlan& plan, std::vector<WallLine>& lines) {
  for (std::size_t i = 0; i < features.size(); ++i) {
    try {
      lines.push_back(line_from(features.at(i), plan));
    } catch (const Json::exception& error) {
      throw BadJson("features[" + std::to_string(i) + "]: " + short_message(error));
    } catch (const std::exception& error) {
      throw BadJson("features[" + std::to_string(i) + "]: " + error.what());
    }
  }
  const auto by_id = [](const WallLine& a, const WallLine& b) { return a.id < b.id; };
  std::sort(lines.begin(), lines.end(), by_id);
  const auto same_id = [](const WallLine& a, const WallLine& b) { return a.id == b.id; };
  const auto twice = std::adjacent_find(lines.begin(), lines.end(), same_id);
  if (twice != lines.end()) {
    throw BadJson("wall_id " + twice->id + " stands twice");
  }
}

}  // namespace

WallLinesFile read_wall_lines(const std::filesystem::path& path) {
  WallLinesFile file;
  LineCoordinates coordinates = LineCoordinates::kScan;
  InputRecord record{"", artefacts::kWallLines.name, "", "", ""};
  try {
    const Json document = parse_json(read_text_file(path));
    const Json& member = document.at(kMember);
    record.schema_version = member.at("schema_version").get<std::string>();
    check_type_and_version(path, member.at("artefact").get<std::string>(), record.schema_version,
                           artefacts::kWallLines);
    coordinates = coordinates_of(member);
    read_member(member, coordinates, file);
    read_features(document.at("features"), FilePlan(file.content.frame, coordinates), file.content.lines);
    record.payload_sha256 = member.at("provenance").at("payload_sha256").get<std::string>();
  } catch (const Json::exception& error) {
    throw_damaged(path, "", "not a wall_lines artefact: " + short_message(error));
  } catch (const BadJson& error) {
    throw_damaged(path, "", error.what());
  }
  file.payload_sha256 = lines_payload_sha256(file.content, coordinates, record.schema_version);
  if (kDigestsCount && file.payload_sha256 != record.payload_sha256) {
    throw StageError(errors::kArtefactDamaged, path.string(), kNotAsWritten,
                     std::string(kMakeAgain) + "; lines drawn by hand go to edits/wall_lines.geojson");
  }
  require_params(path, file.provenance);
  remember_artefact(path, record);
  return file;
}

}  // namespace roomcut

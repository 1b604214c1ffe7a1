// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/artefact/artefact_check.h"
#include "common/artefact/atomic_file.h"
#include "common/artefact/known_artefacts.h"
#include "common/errors/codes.h"
#include "common/wall_lines/wall_lines_format.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut {

namespace {

constexpr double kDegToRad = std::numbers::pi / 180.0;

double finite(const Json& value) {
  const double number = value.get<double>();
  if (!std::isfinite(number)) {
    throw std::invalid_argument("a number is not finite");
  }
  return number;
}

Vec2 point_from(const Json& value) {
  return {finite(value.at(0)), finite(value.at(1))};
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

WallLine line_from(const Json& feature) {
  const Json& geometry = feature.at("geometry");
  const Json& properties = feature.at("properties");
  if (geometry.at("type") != "LineString" || geometry.at("coordinates").size() != 2) {
    throw std::invalid_argument("the geometry is no LineString of two points");
  }
  WallLine line;
  line.id = properties.at("wall_id").get<std::string>();
  line.a = point_from(geometry.at("coordinates").at(0));
  line.b = point_from(geometry.at("coordinates").at(1));
  if (line.a == line.b) {
    throw std::invalid_argument("both ends are equal");
  }
  line.source = source_from_name(properties.at("source").get<std::string>());
  line.locked = properties.at("locked").get<bool>();
  if (!properties.at("levels").is_null()) {
    line.levels = properties.at("levels").get<std::vector<int>>();
  }
  line.support_m = finite(properties.at("support_m"));
  line.rms_m = finite(properties.at("rms_m"));
  line.sigma_offset_m = finite(properties.at("sigma_offset_m"));
  line.sigma_angle_rad = finite(properties.at("sigma_angle_deg")) * kDegToRad;
  if (!properties.at("note").is_null()) {
    line.note = properties.at("note").get<std::string>();
  }
  line.extra_json = unknown_properties(properties);
  return line;
}

void read_member(const Json& member, WallLinesFile& file) {
  if (member.at("length_unit") != "m") {
    throw std::invalid_argument("length_unit is not m");
  }
  file.content.frame = frame_from_json(member.at("frame"));
  const Json& box = member.at("bbox");
  file.content.bbox_min = {finite(box.at(0)), finite(box.at(1))};
  file.content.bbox_max = {finite(box.at(2)), finite(box.at(3))};
  file.content.base_sha256 = member.at("base_sha256").get<std::string>();
  file.provenance = provenance_from_json(member.at("provenance"));
}

void read_features(const Json& features, std::vector<WallLine>& lines) {
  for (std::size_t i = 0; i < features.size(); ++i) {
    try {
      lines.push_back(line_from(features.at(i)));
    } catch (const std::exception& error) {
      throw std::invalid_argument("features[" + std::to_string(i) + "]: " + error.what());
    }
  }
  const auto by_id = [](const WallLine& a, const WallLine& b) { return a.id < b.id; };
  std::sort(lines.begin(), lines.end(), by_id);
  const auto same_id = [](const WallLine& a, const WallLine& b) { return a.id == b.id; };
  const auto twice = std::adjacent_find(lines.begin(), lines.end(), same_id);
  if (twice != lines.end()) {
    throw std::invalid_argument("wall_id " + twice->id + " stands twice");
  }
}

}  // namespace

WallLinesFile read_wall_lines(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  const std::string remedy =
      "make it again with the stage that writes it; lines drawn by hand go to edits/wall_lines.geojson";
  WallLinesFile file;
  try {
    const Json document = Json::parse(text);
    const Json& member = document.at(kMember);
    check_type_and_version(path, member.at("artefact").get<std::string>(),
                           member.at("schema_version").get<std::string>(), artefacts::kWallLines);
    read_member(member, file);
    read_features(document.at("features"), file.content.lines);
    remember_artefact(path, {"", artefacts::kWallLines.name, member.at("schema_version").get<std::string>(),
                             member.at("provenance").at("payload_sha256").get<std::string>(), ""});
  } catch (const Json::exception& error) {
    throw StageError(errors::kArtefactDamaged, path.string(),
                     std::string("not a wall_lines artefact: ") + error.what(), remedy);
  } catch (const std::invalid_argument& error) {
    throw StageError(errors::kArtefactDamaged, path.string(), error.what(), remedy);
  }
  file.payload_sha256 = wall_lines_payload_sha256(file.content);
  return file;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/edit_document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "common/wall_lines/duplicate_keys.h"
#include "common/wall_lines/edit_values.h"
#include "common/wall_lines/wall_lines_format.h"

namespace roomcut {

namespace {

constexpr double kSameOrigin_m = 1e-4;  // a rescan with a few points more has another mean
constexpr std::size_t kMostDuplicates =
    20;  ///< reported; who has more has a broken program, not more to learn

std::string text_of(const std::filesystem::path& path) {
  std::error_code failure;
  const bool folder = std::filesystem::is_directory(path, failure);
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!folder && stream && stream.peek() != std::ifstream::traits_type::eof()) {
    text << stream.rdbuf();
  }
  if (folder || !stream.is_open() || stream.bad()) {
    throw StageError(errors::kLinesUnreadable, path.string(),
                     folder ? "is a folder, not a file" : "cannot be read",
                     "check the path and the permissions");
  }
  return text.str();
}

Json parse(const std::string& text, const EditReport& report) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw StageError(
        errors::kLinesNotJson, report.path, "the file is empty",
        std::string("save it again, or remove it to work with the detected ") + report.kind.things);
  }
  try {
    return parse_json(text);
  } catch (const BadJson& error) {
    throw StageError(errors::kLinesNotJson, report.path, std::string("not JSON: ") + error.what(),
                     "look at the place named: a missing or a trailing comma, an open bracket or quote?");
  }
}

void check_collection(const Json& document, const EditReport& report) {
  const bool collection = document.is_object() && document.contains("type") &&
                          document["type"] == "FeatureCollection" && document.contains("features") &&
                          document["features"].is_array();
  if (!collection) {
    throw StageError(errors::kLinesNotFeatureCollection, report.path,
                     "no GeoJSON FeatureCollection with a list of features",
                     std::string("export the layer as GeoJSON, or start from `") + report.kind.copy + "`");
  }
}

std::string text_member(const Json& object, const char* key) {
  return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string();
}

void check_version(const Json& member, EditReport& report) {
  const std::string version = text_member(member, "schema_version");
  int major = -1;
  int minor = -1;
  const char* end = version.data() + version.size();
  const auto first = std::from_chars(version.data(), end, major);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == '.') {
    std::from_chars(first.ptr + 1, end, minor);
  }
  const ArtefactType type = report.kind.type;
  if (major < 1 || minor < 0) {
    report.problem(errors::kLinesVersion, kMember, "schema_version \"" + version + "\" is no version",
                   std::string("write \"1.0\" as in the detected ") + report.kind.things +
                       ", or delete the whole member");
  } else if (major > type.major || (major == type.major && minor > type.minor)) {
    report.problem(errors::kLinesVersion, kMember,
                   "has schema version " + version + ", this roomcut reads up to " +
                       std::to_string(type.major) + "." + std::to_string(type.minor),
                   "use the roomcut that wrote it, or a newer one");
  }
}

/// The file's own frame; the base's where it has none that can be used.
Frame check_frame(const Json& member, const Frame& base, EditReport& report) {
  if (member.contains("length_unit") && member["length_unit"] != "m") {
    std::string what = "length_unit is ";
    what.append(excerpt(member["length_unit"]))
        .append(", ")
        .append(report.kind.things)
        .append(" are in \"m\"");
    report.problem(errors::kLinesUnit, kMember, what, "scale the coordinates to metres and write \"m\"");
  }
  if (!member.contains("frame")) {
    return base;
  }
  Frame frame;
  try {
    frame = frame_from_json(member["frame"]);
  } catch (const std::exception&) {
    report.problem(errors::kLinesUnit, kMember, "frame is not complete, or not one",
                   std::string("copy the member `frame` from the detected ") + report.kind.things);
    return base;
  }
  if (frame.unit != base.unit || frame.up != base.up) {
    report.problem(errors::kLinesUnit, kMember,
                   "was drawn on a scan read with --unit " + frame.unit + " --up " + frame.up +
                       ", this one was read with --unit " + base.unit + " --up " + base.up,
                   std::string("ingest the scan as before, or draw the edit anew (`") + report.kind.drop +
                       "`, `" + report.kind.copy + "`)");
    return base;
  }
  return frame;
}

Vec2 moved_by(const Frame& frame, const Frame& base) {
  return {frame.origin[0] - base.origin[0], frame.origin[1] - base.origin[1]};
}

LineCoordinates check_coordinates(const Json& member, EditReport& report) {
  if (!member.contains(kCoordinatesKey)) {
    return report.kind.unstated;
  }
  if (member[kCoordinatesKey] == kLocalCoordinates) {
    return LineCoordinates::kLocal;
  }
  if (member[kCoordinatesKey] != kScanCoordinates) {
    report.problem(errors::kLinesUnit, kMember,
                   std::string(kCoordinatesKey) + " is " + excerpt(member[kCoordinatesKey]) +
                       ", must be \"scan\" or \"local\"",
                   std::string("write \"scan\" when the ") + report.kind.things + " lie on the scan");
  }
  return LineCoordinates::kScan;
}

}  // namespace

Json read_edit_document(const std::filesystem::path& path, EditReport& report) {
  const std::string text = text_of(path);
  Json document = parse(text, report);
  check_collection(document, report);
  for (const DuplicateKey& duplicate : find_duplicate_keys(text, kMostDuplicates)) {
    report.problem(errors::kLinesDuplicateKey, duplicate.object,
                   "the key \"" + duplicate.key + "\" stands twice", "keep the one that is meant");
  }
  return document;
}

EditPlan::EditPlan(LineCoordinates coordinates, const Frame& own, const Frame& base)
    : coordinates_(coordinates),
      own_(own),
      base_(base),
      as_it_is_(coordinates == LineCoordinates::kLocal && moved_by(own, base).norm() <= kSameOrigin_m &&
                std::equal(std::begin(own.level), std::end(own.level), std::begin(base.level))) {}

Vec2 EditPlan::to_base(const Vec2& drawn) const {
  if (as_it_is_) {
    return drawn;
  }
  return without_rounding(
      base_.plan_to_local(coordinates_ == LineCoordinates::kScan ? drawn : own_.plan_to_scan(drawn)));
}

double EditPlan::height_to_base(const Vec2& drawn, double height) const {
  const bool local = coordinates_ == LineCoordinates::kLocal;
  return without_rounding(
      base_.height_to_local(to_base(drawn), local ? own_.height_to_scan(drawn, height) : height));
}

Vec2 EditPlan::direction_to_base(const Vec2& drawn) const {
  if (as_it_is_) {
    return drawn;
  }
  const Vec2 in_scan = coordinates_ == LineCoordinates::kLocal ? Vec2(own_.plan_turn() * drawn) : drawn;
  return (base_.plan_turn().inverse() * in_scan).normalized();
}

EditOrigin read_edit_member(const Json& document, const Frame& base_frame, EditReport& report) {
  EditOrigin origin;
  origin.frame = base_frame;
  if (!document.contains(kMember)) {
    std::string what = "the member `";
    what.append(kMember)
        .append("` is missing; unit, frame and base are taken from the detected ")
        .append(report.kind.things);
    report.warn("", what);
    return origin;
  }
  const Json& member = document[kMember];
  if (!member.is_object() || text_member(member, "artefact") != report.kind.type.name) {
    report.problem(
        errors::kLinesNoMember, kMember,
        std::string("does not say \"artefact\": \"") + report.kind.type.name + "\"",
        std::string("restore it from the detected ") + report.kind.things + ", or delete the whole member");
    return origin;
  }
  check_version(member, report);
  origin.base_sha256 = text_member(member, "base_sha256");
  if (!origin.base_sha256.empty() && !is_digest(origin.base_sha256)) {
    report.warn(kMember, "base_sha256 is no digest; the edit counts as begun from this detection");
    origin.base_sha256.clear();
  }
  origin.coordinates = check_coordinates(member, report);
  origin.frame = check_frame(member, base_frame, report);
  const double moved = moved_by(origin.frame, base_frame).norm();
  if (origin.coordinates == LineCoordinates::kLocal && moved > kSameOrigin_m) {
    report.warn(kMember, "the scan's origin moved by " + std::to_string(moved) +
                             " m since the edit began; its " + report.kind.things + " were moved along");
  }
  return origin;
}

}  // namespace roomcut

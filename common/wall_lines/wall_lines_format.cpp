// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/wall_lines_format.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/artefact/artefact_check.h"
#include "common/artefact/frame_crs.h"
#include "common/artefact/json_values.h"
#include "common/artefact/sha256.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut {

namespace {

constexpr double kRadToDeg = 180.0 / std::numbers::pi;

constexpr std::array<std::pair<LineSource, std::string_view>, 4> kSources{
    {{LineSource::kDetected, "detected"},
     {LineSource::kEdited, "edited"},
     {LineSource::kAdded, "added"},
     {LineSource::kRefined, "refined"}}};

/// Six decimals whatever the locale.
std::string fixed(double value) {
  if (!std::isfinite(value)) {
    throw std::logic_error("wall_lines: a value is not finite");
  }
  std::array<char, 400> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 6).ptr;
  std::string text(buffer.data(), end);
  return text == "-0.000000" ? "0.000000" : text;
}

std::string json_text(std::string_view text) {
  return canonical_json(text);
}

std::string levels_text(const WallLine& line) {
  return line.levels ? canonical_json(*line.levels) : "null";
}

std::string point_text(const Vec2& point) {
  return fixed(point.x()) + ", " + fixed(point.y());
}

std::string feature_text(const WallLine& line, const FilePlan& plan) {
  std::string text =
      R"({"type": "Feature", "id": )" + json_text(line.id) + R"(, "properties": {"wall_id": )" +
      json_text(line.id) + R"(, "source": )" + json_text(source_name(line.source)) + R"(, "locked": )" +
      (line.locked ? "true" : "false") + R"(, "levels": )" + levels_text(line) + R"(, "support_m": )" +
      fixed(line.support_m) + R"(, "rms_m": )" + fixed(line.rms_m) + R"(, "sigma_offset_m": )" +
      fixed(line.sigma_offset_m) + R"(, "sigma_angle_deg": )" + fixed(line.sigma_angle_rad * kRadToDeg) +
      R"(, "note": )" + (line.note.empty() ? "null" : json_text(line.note));
  const Json extra = parse_json(line.extra_json);
  for (const auto& item : extra.items()) {
    text += ", " + json_text(item.key()) + ": " + canonical_json(item.value());
  }
  return text + R"(}, "geometry": {"type": "LineString", "coordinates": [[)" +
         point_text(plan.to_file(line.a)) + "], [" + point_text(plan.to_file(line.b)) + "]]}}";
}

std::string box_text(const WallLines& lines, const FilePlan& plan) {
  return "[" + point_text(plan.to_file(lines.bbox_min)) + ", " + point_text(plan.to_file(lines.bbox_max)) +
         "]";
}

std::string features_text(const WallLines& lines, const FilePlan& plan) {
  std::string text;
  for (const WallLine& line : lines.lines) {
    text += (text.empty() ? "" : ",\n") + feature_text(line, plan);
  }
  return text;
}

}  // namespace

std::string_view source_name(LineSource source) {
  for (const auto& [value, name] : kSources) {
    if (value == source) {
      return name;
    }
  }
  throw std::logic_error("wall_lines: unknown source");
}

LineSource source_from_name(std::string_view name) {
  for (const auto& [value, known] : kSources) {
    if (known == name) {
      return value;
    }
  }
  throw std::invalid_argument("unknown source");
}

double rounded_coordinate(double value) {
  const double result = std::round(value * 1e6) / 1e6;
  return result == 0 ? 0 : result;
}

Vec2 rounded_point(const Vec2& point) {
  return {rounded_coordinate(point.x()), rounded_coordinate(point.y())};
}

Vec2 FilePlan::to_file(const Vec2& local) const {
  return rounded_point(local_ ? local : scan_.plan_to_scan(local));
}

WallLines normalised_lines(WallLines lines, LineCoordinates coordinates) {
  const FilePlan plan(lines.frame, coordinates);
  lines.bbox_min = plan.to_local(plan.to_file(lines.bbox_min));
  lines.bbox_max = plan.to_local(plan.to_file(lines.bbox_max));
  for (WallLine& line : lines.lines) {
    Vec2 a = plan.to_file(line.a);
    Vec2 b = plan.to_file(line.b);
    if (std::pair(b.x(), b.y()) < std::pair(a.x(), a.y())) {
      std::swap(a, b);
    }
    line.a = plan.to_local(a);
    line.b = plan.to_local(b);
  }
  std::sort(lines.lines.begin(), lines.lines.end(),
            [](const WallLine& a, const WallLine& b) { return a.id < b.id; });
  return lines;
}

std::string wall_lines_text(const WallLines& normalised, const Provenance& provenance,
                            const std::string& payload_sha256) {
  const FilePlan plan(normalised.frame, LineCoordinates::kScan);
  Json made = to_json(provenance);
  made["payload_sha256"] = payload_sha256;
  return std::string("{\n\"type\": \"FeatureCollection\",\n\"name\": \"wall_lines\",\n") +
         "\"crs\": {\"type\": \"name\", \"properties\": {\"name\": " + json_text(crs_of(normalised.frame)) +
         "}},\n\"" + kMember + "\": {\n\"artefact\": \"wall_lines\",\n\"schema_version\": " +
         json_text(version_text(artefacts::kWallLines)) + ",\n\"length_unit\": \"m\",\n\"" + kCoordinatesKey +
         "\": \"" + kScanCoordinates + "\",\n\"frame\": " + canonical_json(to_json(normalised.frame)) +
         ",\n\"bbox\": " + box_text(normalised, plan) +
         ",\n\"base_sha256\": " + json_text(normalised.base_sha256) +
         ",\n\"provenance\": " + canonical_json(made) + "\n},\n\"features\": [\n" +
         features_text(normalised, plan) + "\n]\n}\n";
}

std::string lines_payload_sha256(const WallLines& lines, LineCoordinates coordinates,
                                 const std::string& version) {
  const WallLines normalised = normalised_lines(lines, coordinates);
  const FilePlan plan(normalised.frame, coordinates);
  return sha256_hex(version + "\n" + canonical_json(to_json(normalised.frame)) + "\n" +
                    box_text(normalised, plan) + "\n" + features_text(normalised, plan));
}

std::string wall_lines_payload_sha256(const WallLines& lines) {
  return lines_payload_sha256(lines, LineCoordinates::kScan, version_text(artefacts::kWallLines));
}

bool write_wall_lines(const std::filesystem::path& path, const WallLines& lines,
                      const Provenance& provenance) {
  const std::string digest = wall_lines_payload_sha256(lines);
  return publish_json(path, wall_lines_text(normalised_lines(lines), provenance, digest), digest);
}

}  // namespace roomcut

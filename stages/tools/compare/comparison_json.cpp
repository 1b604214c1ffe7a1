// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "common/artefact/artefact_check.h"
#include "common/artefact/json_values.h"
#include "common/geometry/scan_coordinates.h"
#include "stages/tools/compare/comparison_json.h"

namespace roomcut::compare {

namespace {

constexpr ArtefactType kComparison{"comparison", 1, 0};

Json run_json(const RunFacts& run) {
  return {{"name", run.name},
          {"scan_sha256", run.scan_sha256},
          {"edited", run.edited},
          {"lines_file", run.lines_file}};
}

Json line_json(const WallLine& line, const ScanCoordinates& scan) {
  const Vec2 from = scan.plan_to_scan(line.a);
  const Vec2 to = scan.plan_to_scan(line.b);
  return {
      {"wall_id", line.id}, {"length_m", line.length()}, {"ends_m", {from.x(), from.y(), to.x(), to.y()}}};
}

Json lines_json(const RunFacts& a, const RunFacts& b, const LineMatches& lines) {
  Json out = {
      {"same", lines.same()}, {"moved", Json::array()}, {"only_a", Json::array()}, {"only_b", Json::array()}};
  for (const LinePair& pair : lines.pairs) {
    if (!pair.same()) {
      out["moved"].push_back({{"a", a.lines[pair.a].id},
                              {"b", b.lines[pair.b].id},
                              {"offset_m", pair.move.offset_m},
                              {"angle_deg", pair.move.angle_rad * 180 / std::numbers::pi},
                              {"ends_m", pair.move.ends_m}});
    }
  }
  const auto b_lines = lines_in(b, a.frame);
  const ScanCoordinates scan(a.frame);
  for (const std::size_t i : lines.only_a) {
    out["only_a"].push_back(line_json(a.lines[i], scan));
  }
  for (const std::size_t i : lines.only_b) {
    out["only_b"].push_back(line_json(b_lines[i], scan));
  }
  return out;
}

Json spaces_json(const std::vector<SpaceFacts>& a, const std::vector<SpaceFacts>& b, const Matches& matches) {
  Json out = {{"both", Json::array()}, {"only_a", Json::array()}, {"only_b", Json::array()}};
  for (const auto& [i, k] : matches.both) {
    out["both"].push_back({{"a", a[i].number},
                           {"b", b[k].number},
                           {"area_m2", {a[i].area_m2, b[k].area_m2}},
                           {"volume_m3", {a[i].volume_m3, b[k].volume_m3}},
                           {"height_m", {a[i].height_m, b[k].height_m}},
                           {"unobserved_m3", {a[i].unobserved_m3, b[k].unobserved_m3}}});
  }
  for (const std::size_t i : matches.only_a) {
    out["only_a"].push_back(a[i].number);
  }
  for (const std::size_t k : matches.only_b) {
    out["only_b"].push_back(b[k].number);
  }
  return out;
}

Json way_json(const ModelDistance::OneWay& way) {
  return {
      {"mean_m", way.mean_m}, {"rms_m", way.rms_m}, {"p95_m", way.p95_m}, {"hausdorff_m", way.hausdorff_m}};
}

Json distance_json(const ModelDistance& distance) {
  return {{"a_to_b", way_json(distance.a_to_b)},
          {"b_to_a", way_json(distance.b_to_a)},
          {"a_m3", distance.a_m3},
          {"b_m3", distance.b_m3},
          {"common_m3", distance.common_m3}};
}

Json comparison_json(const RunFacts& a, const RunFacts& b, const Comparison& comparison,
                     const std::optional<ModelDistance>& distance) {
  Json parameters = Json::array();
  for (const ParameterDifference& difference : comparison.parameters) {
    parameters.push_back({{"parameter", difference.parameter}, {"a", difference.a}, {"b", difference.b}});
  }
  Json totals = Json::object();
  for (const auto& [name, value] : a.totals) {
    totals[name] = {value, nullptr};
  }
  for (const auto& [name, value] : b.totals) {
    totals[name] = {totals.contains(name) ? totals[name][0] : Json(), value};
  }
  return {{"a", run_json(a)},
          {"b", run_json(b)},
          {"same_scan", comparison.same_scan},
          {"parameters", parameters},
          {"totals", totals},
          {"lines", lines_json(a, b, comparison.lines)},
          {"storeys", spaces_json(a.storeys, b.storeys, comparison.storeys)},
          {"rooms", spaces_json(a.rooms, b.rooms, comparison.rooms)},
          {"distance", distance ? distance_json(*distance) : Json()}};
}

}  // namespace

ModelDistance read_distance(const std::filesystem::path& scores) {
  const Json json = read_json_artefact(scores, artefacts::kScores);
  const auto way = [&](const char* name) {
    const Json& one = json.at("distance").at(name);
    return ModelDistance::OneWay{one.at("mean_m"), one.at("rms_m"), one.at("p95_m"), one.at("hausdorff_m")};
  };
  try {
    ModelDistance distance{way("model_to_truth"), way("truth_to_model"), 0, 0, 0};
    if (const Json& volume = json.at("volume"); volume.is_object()) {
      distance.a_m3 = volume.at("truth_m3");
      distance.b_m3 = volume.at("model_m3");
      distance.common_m3 = volume.at("common_m3");
    }
    return distance;
  } catch (const Json::exception& error) {
    throw_damaged(scores, "", "a value is missing or of another type: " + short_message(error));
  }
}

void write_comparison(const std::filesystem::path& path, const RunFacts& a, const RunFacts& b,
                      const Comparison& comparison, const std::optional<ModelDistance>& distance,
                      const Provenance& provenance) {
  write_json_artefact(path, kComparison, provenance, a.frame, comparison_json(a, b, comparison, distance));
}

}  // namespace roomcut::compare

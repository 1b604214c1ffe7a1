// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <filesystem>
#include <span>
#include <string_view>

#include "common/artefact/atomic_file.h"
#include "common/artefact/h5.h"
#include "common/openings/openings_io.h"
#include "common/picture/colour_map.h"
#include "common/pipeline/pipeline_table.h"
#include "common/slices/slices_io.h"
#include "common/wall_lines/wall_lines_format.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/tools/report/page_blocks.h"

namespace roomcut::report {

namespace {

/// What a log says of a run apart from where and when it was.
constexpr std::array kLogMembers = {"stage",   "revision", "version", "wall_s", "cpu_s",   "peak_memory_mb",
                                    "threads", "params",   "chosen",  "counts", "warnings"};

/// The summary with nothing that no digest covers.
Json summary_facts(const std::filesystem::path& path) {
  Json facts = read_json_artefact(path, artefacts::kSummary);
  facts.erase("provenance");
  return facts;
}

/// What the reader believes of a file of lines, as the file would have it: what else stands in it no digest
/// covers.
Json lines_facts(const std::filesystem::path& path, bool openings) {
  Json document;
  if (openings) {
    document = parse_json(openings_text(read_openings(path).content, {}));
  } else {
    document = parse_json(wall_lines_text(normalised_lines(read_wall_lines(path).content), {}, ""));
  }
  document["roomcut"].erase("provenance");
  return document;
}

Json levels_of(const Slices& slices) {
  Json levels = Json::array();
  for (const Level& level : slices.levels) {
    levels.push_back({{"z", level.z},
                      {"lo", level.lo},
                      {"hi", level.hi},
                      {"area_m2", level.area_m2},
                      {"component_m2", level.component_m2},
                      {"cap", level.cap},
                      {"step", level.step}});
  }
  return levels;
}

void add_slices(const StageRun& run, PageBlockBuilder& block) {
  const Slices slices = read_slices(run.input("slices"));
  const auto& histogram = slices.histogram;
  block.facts["levels"] = levels_of(slices);
  block.facts["histogram"] = {{"z0", histogram.z0}, {"bin_m", histogram.bin_m}};
  block.facts["noise_m"] = slices.noise_m;
  block.facts["density"] = slices.density;
  block.facts["tau_m"] = slices.tau_m;
  block.facts["bbox"] = {slices.bbox_min.x(), slices.bbox_min.y(), slices.bbox_min.z(),
                         slices.bbox_max.x(), slices.bbox_max.y(), slices.bbox_max.z()};
  block.facts["frame"] = to_json(slices.frame);
  block.add("histogram_area", std::vector<float>(histogram.area_m2.begin(), histogram.area_m2.end()));
}

Json stops_json(std::span<const Colour> stops) {
  Json list = Json::array();
  for (const Colour& colour : stops) {
    list.push_back({colour.r, colour.g, colour.b});
  }
  return list;
}

/// The page draws in the colours of the pictures.
Json colours_json() {
  Json categorical = Json::array();
  for (const NamedColour& item : categorical_colours()) {
    categorical.push_back({item.name, hex(item.colour)});
  }
  return {{"categorical", categorical},
          {"sequential", stops_json(sequential_stops())},
          {"diverging", stops_json(diverging_stops())}};
}

}  // namespace

void add_run_blocks(const StageRun& run, std::vector<PageBlock>& blocks) {
  PageBlockBuilder facts("run");
  facts.facts["colours"] = colours_json();
  if (run.has_input("slices")) {
    add_slices(run, facts);
  }
  if (run.has_input("summary")) {
    facts.facts["summary"] = summary_facts(run.input("summary"));
  }
  blocks.push_back(facts.finish());

  PageBlockBuilder lines("lines");
  for (const char* input : {"detected", "lines", "refined", "openings"}) {
    if (run.has_input(input)) {
      lines.facts[input] = lines_facts(run.input(input), std::string_view(input) == "openings");
    }
  }
  blocks.push_back(lines.finish());
}

void add_log_block(const StageRun& run, std::vector<PageBlock>& blocks) {
  PageBlockBuilder logs("logs");
  logs.facts["stages"] = Json::array();
  const std::filesystem::path folder = run.output("report").parent_path() / "logs";
  for (const PipelineRun& part : pipeline_table().runs()) {
    if (part.program == "report") {
      continue;
    }
    const std::filesystem::path file = folder / (part.name + ".json");
    const Json log = std::filesystem::exists(file) ? try_parse_json(read_text_file(file)) : Json();
    if (!log.is_object()) {
      continue;
    }
    Json kept = {{"run", part.name}};
    for (const char* member : kLogMembers) {
      if (log.contains(member)) {
        kept[member] = log[member];
      }
    }
    logs.facts["stages"].push_back(kept);
  }
  blocks.push_back(logs.finish());
}

}  // namespace roomcut::report

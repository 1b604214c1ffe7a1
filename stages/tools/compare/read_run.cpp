// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/compare/read_run.h"

#include "common/artefact/artefact_check.h"
#include "common/artefact/atomic_file.h"
#include "common/artefact/h5.h"
#include "common/artefact/json_values.h"
#include "common/cells/cells_io.h"
#include "common/errors/codes.h"
#include "common/openings/openings_io.h"
#include "common/pipeline/pipeline_table.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut::compare {

namespace fs = std::filesystem;

namespace {

constexpr int kMostSpaces = 1'000'000;
/// Below the work folder.
const std::string& path_of(const char* artefact) {
  return pipeline_table().path(artefact);
}

/// The file of a run that states its parameters; empty for runs without one.
std::string stating_file(const PipelineRun& run) {
  for (const RunFile& file : run.writes) {
    const std::string extension = fs::path(file.path).extension();
    if (extension == ".h5" || extension == ".geojson" || extension == ".json") return file.path;
  }
  return "";
}

/// The stages with parameters and an artefact that tells which; the second pass has those of the first.
std::vector<std::pair<std::string, std::string>> stating_stages() {
  std::vector<std::pair<std::string, std::string>> stages;
  for (const PipelineRun& run : pipeline_table().runs()) {
    const std::string file = stating_file(run);
    if (run.name == run.program && !file.empty()) stages.emplace_back(run.name, file);
  }
  return stages;
}

bool there(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : canonical_json(value);
}

/// Runs `read`; what it finds to be missing or of another type in a JSON file is damage of that file.
template <class Read>
auto reading(const fs::path& path, const char* remedy, Read read) {
  const auto damaged = [&](const std::string& what) {
    return StageError(errors::kArtefactDamaged, path.string(), what, remedy);
  };
  try {
    return read();
  } catch (const Json::exception& error) {
    throw damaged("a value is missing or of another type: " + short_message(error));
  } catch (const BadJson& error) {
    throw damaged(error.what());
  }
}

/// What `auto` came to in this run, from the stage's log.
Json chosen_values(const fs::path& log) {
  if (!there(log)) {
    return Json::object();
  }
  return reading(log, "delete it: then only what `auto` came to is not shown", [&log] {
    Json values = Json::object();
    const Json content = parse_json(read_text_file(log));
    for (const Json& choice : content.value("chosen", Json::array())) {
      values[choice.at("parameter").get<std::string>()] = choice.at("value");
    }
    return values;
  });
}

void read_parameters(const fs::path& folder, RunFacts& run) {
  for (const auto& [stage, file] : stating_stages()) {
    if (!there(folder / file)) {
      continue;
    }
    const Provenance provenance = read_provenance(folder / file);
    const Json chosen = chosen_values(folder / "logs" / (stage + ".json"));
    const Json parameters = try_parse_json(provenance.params_json);
    for (const auto& [name, value] : parameters.items()) {
      std::string text = text_of(value);
      if (chosen.contains(name)) {
        text += " (" + text_of(chosen[name]) + ")";
      }
      run.parameters.emplace_back(stage + "." + name, text);
    }
    run.parameters.emplace_back(stage + " (revision)", std::to_string(provenance.stage_revision));
    for (const InputRecord& input : provenance.inputs) {
      run.scan_sha256 = input.name == "scan" ? input.payload_sha256 : run.scan_sha256;
      run.edited = run.edited || input.name == "edit";
    }
  }
}

int index_in(const Json& entry, const char* name, int otherwise) {
  return entry.contains(name) ? static_cast<int>(whole_number_in(entry[name], 0, kMostSpaces)) : otherwise;
}

SpaceFacts space_of(const Json& entry) {
  SpaceFacts space;
  space.storey = index_in(entry, "storey", 0);
  space.number = index_in(entry, "room", space.storey);
  if (entry.contains("centre_m")) {
    space.centre = {scan_metres(entry["centre_m"].at(0)), scan_metres(entry["centre_m"].at(1))};
  }
  space.floor_z = scan_metres(entry.value("floor_z_m", Json(0)));
  space.ceiling_z = scan_metres(entry.value("ceiling_z_m", Json(0)));
  space.area_m2 = entry.value("area_m2", 0.0);
  space.volume_m3 = entry.value("volume_m3", 0.0);
  space.height_m = entry.value("height_m", 0.0);
  space.unobserved_m3 = entry.value("unobserved_m3", 0.0);
  return space;
}

void read_summary(const fs::path& path, RunFacts& run) {
  const Json summary = read_json_artefact(path, artefacts::kSummary);
  for (const Json& storey : summary.at("storeys")) {
    run.storeys.push_back(space_of(storey));
  }
  for (const Json& room : summary.at("rooms")) {
    run.rooms.push_back(space_of(room));
  }
  const auto add = [&](const char* name, const char* pointer) {
    run.totals.emplace_back(name, summary.value(Json::json_pointer(pointer), 0.0));
  };
  run.totals.emplace_back("storeys", static_cast<double>(run.storeys.size()));
  run.totals.emplace_back("rooms", static_cast<double>(run.rooms.size()));
  run.totals.emplace_back("openings", static_cast<double>(summary.value("openings", Json::array()).size()));
  add("area_m2", "/totals/area_m2");
  add("volume_m3", "/totals/volume_m3");
  add("wall_m2", "/totals/wall_m2");
  add("unknown_m3", "/totals/unknown_m3");
  add("unobserved_empty_m3", "/totals/unobserved_empty_m3");
  add("unobserved_solid_m3", "/totals/unobserved_solid_m3");
  add("energy_m3", "/energy/total_m3");
  add("energy_data_m3", "/energy/data_m3");
  add("energy_boundary_m3", "/energy/boundary_m3");
  add("lines", "/counts/lines");
  add("levels", "/counts/levels");
  add("cells", "/counts/cells");
  add("triangles", "/counts/triangles");
}

void read_plan(const fs::path& folder, RunFacts& run) {
  for (const auto& [cells_file, labels_file] :
       {std::pair{path_of("final_cells"), path_of("final_labels")}, {path_of("cells"), path_of("labels")}}) {
    if (there(folder / cells_file) && there(folder / labels_file)) {
      CellsFile cells = read_cells(folder / cells_file);
      Labels labels = read_labels(folder / labels_file, cells);
      run.plan = RunPlan{std::move(cells.complex), std::move(labels)};
      return;
    }
  }
}

}  // namespace

RunFacts read_run(const fs::path& folder) {
  if (!there(folder / path_of("cloud"))) {
    throw StageError(errors::kArtefactMissing, (folder / path_of("cloud")).string(),
                     "there is no run in this folder",
                     "name two work folders: make compare A=work/x B=work/y");
  }
  RunFacts run;
  const fs::path whole = fs::weakly_canonical(folder);
  run.name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  read_parameters(folder, run);
  for (const char* name : {"refined", "accepted"}) {
    const std::string& file = path_of(name);
    if (there(folder / file)) {
      WallLines lines = read_wall_lines(folder / file).content;
      run.frame = lines.frame;
      run.lines = std::move(lines.lines);
      run.lines_file = file;
      break;
    }
  }
  read_plan(folder, run);
  if (there(folder / path_of("openings"))) {
    run.openings = read_openings(folder / path_of("openings")).content.openings;
  }
  if (there(folder / path_of("summary"))) {
    const fs::path summary = folder / path_of("summary");
    reading(summary, kMakeAgain, [&] { read_summary(summary, run); });
  }
  return run;
}

}  // namespace roomcut::compare

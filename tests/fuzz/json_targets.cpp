// SPDX-License-Identifier: GPL-3.0-or-later
// JSON artefacts and GeoJSON, the hand edit, logs, truths, resolved parameters.
#include <array>

#include "common/openings/openings_io.h"
#include "common/params/params.h"
#include "common/slices/slices_io.h"
#include "common/sloped_planes/planes_io.h"
#include "common/wall_lines/compare_lines.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/accept_lines/accept_lines.h"
#include "stages/accept_planes/accept_planes.h"
#include "stages/tools/compare/comparison_json.h"
#include "stages/tools/compare/read_run.h"
#include "stages/tools/evaluate/evaluate_io.h"
#include "tests/fuzz/target.h"

namespace roomcut::fuzz {
using namespace roomcut::accept_lines;
using namespace roomcut::compare;
using namespace roomcut::evaluate;

namespace {

/// As the stages do: what was read is written again.
void wall_lines(std::string_view bytes) {
  const PrivateFile file(bytes, ".geojson");
  const WallLinesFile lines = read_wall_lines(file.path());
  write_wall_lines(private_folder() / "written.geojson", lines.content, lines.provenance);
}

/// What accept_lines does with a hand edit.
void edit(std::string_view bytes) {
  static const WallLinesFile kBase = read_wall_lines(seeds() / "30_detect_lines/wall_lines.geojson");
  const PrivateFile file(bytes, ".geojson");
  const WallLinesFile edited = read_edited_wall_lines(file.path(), kBase.content);
  const Acceptance accepted = accept_lines::accept_lines(kBase.content, kBase.payload_sha256, edited.content);
  write_wall_lines(private_folder() / "written.geojson", accepted.lines, kBase.provenance);
}

void planes(std::string_view bytes) {
  const PrivateFile file(bytes, ".geojson");
  const PlanesFile planes = read_planes_file(file.path());
  write_planes_file(private_folder() / "written.geojson", planes.content, planes.provenance);
}

/// What accept_planes does with a hand edit, of the run's building.
void planes_edit(std::string_view bytes) {
  static const Slices kSlices = read_slices(seeds() / "20_slice/slices.h5", false);
  static const AcceptedPlanes kBase = accept_planes::detected_planes(kSlices);
  const PrivateFile file(bytes, ".geojson");
  const PlanesFile edited = read_edited_planes(file.path(), kBase);
  const auto accepted = accept_planes::accept_planes(kSlices, kBase, edited.payload_sha256, edited.content);
  write_planes_file(private_folder() / "written.geojson", accepted.planes, edited.provenance);
}

void openings(std::string_view bytes) {
  const PrivateFile file(bytes, ".geojson");
  const OpeningsFile openings = read_openings(file.path());
  write_openings(private_folder() / "written.geojson", openings.content, Provenance{});
}

/// A work folder that holds only the given file besides what read_run() asks for.
void run_with(std::string_view bytes, const std::filesystem::path& name) {
  const std::filesystem::path run = private_folder() / "run";
  std::filesystem::create_directories((run / name).parent_path());
  for (const char* needed : {"10_ingest/cloud.h5", "20_slice/slices.h5"}) {
    std::filesystem::create_directories((run / needed).parent_path());
    if (!std::filesystem::exists(run / needed)) {
      std::filesystem::create_symlink(std::filesystem::absolute(seeds() / needed), run / needed);
    }
  }
  const PrivateFile file(bytes);
  std::filesystem::rename(file.path(), run / name);
  struct Remove {
    std::filesystem::path path;
    ~Remove() { std::filesystem::remove(path); }
  } const remove{run / name};
  read_run(run);
}

void summary(std::string_view bytes) {
  run_with(bytes, "summary.json");
}
void run_log(std::string_view bytes) {
  run_with(bytes, "logs/slice.json");
}

void scores(std::string_view bytes) {
  const PrivateFile file(bytes, ".json");
  read_distance(file.path());
}

void truth_json(std::string_view bytes) {
  const PrivateFile file(bytes, ".json");
  read_truth_description(file.path(), {});
}

void params_dump(std::string_view bytes) {
  double share = 0.5;
  std::optional<double> length;
  int count = 3;
  bool enabled = true;
  std::string way = "one";
  ParameterTable table = {number("share", share, "1", 0, 1, "A share."),
                          auto_number("length_m", length, "m", 0, 10, "A length.", ""),
                          integer("count", count, "1", 1, 9, "A count."),
                          boolean("enabled", enabled, "A switch."),
                          choice("way", way, {"one", "other"}, "A way.")};
  const PrivateFile file(bytes, ".json");
  load_dump(file.path(), "slice", table);
}

constexpr std::array kTargets{
    Target{"wall_lines", Mutation::kJson, wall_lines, "40_accept_lines/wall_lines.geojson"},
    Target{"edit", Mutation::kJson, edit, "40_accept_lines/wall_lines.geojson"},
    Target{"planes", Mutation::kJson, planes, "45_accept_planes/planes.geojson"},
    Target{"planes_edit", Mutation::kJson, planes_edit, "45_accept_planes/planes.geojson"},
    Target{"openings", Mutation::kJson, openings, "95_find_openings/openings.geojson"},
    Target{"summary", Mutation::kJson, summary, "summary.json"},
    Target{"run_log", Mutation::kJson, run_log, "logs/slice.json"},
    Target{"scores", Mutation::kJson, scores, "evaluate/scores.json"},
    Target{"truth_json", Mutation::kJson, truth_json, "truth.json"},
    Target{"params_dump", Mutation::kJson, params_dump, "params/slice.json"}};

}  // namespace

std::span<const Target> json_targets() {
  return kTargets;
}

}  // namespace roomcut::fuzz

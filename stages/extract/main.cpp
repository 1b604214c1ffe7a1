// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdio>

#include "common/cells/cells_io.h"
#include "common/cells/surfaces_io.h"
#include "common/cli/run_stage.h"
#include "common/errors/codes.h"
#include "common/openings/openings_io.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/extract/extract.h"
#include "stages/extract/model_files.h"
#include "stages/extract/params.h"

namespace {

using namespace roomcut;
using namespace roomcut::extract;

StageInfo info() {
  StageInfo stage;
  stage.name = "extract";
  stage.revision = 9;
  stage.summary = "Turns the labelled cells into a closed model: model.ply, model.obj, summary.json";
  stage.inputs = {{"cells", "Cell decomposition"},
                  {"weights", "Evidence on the faces"},
                  {"terms", "Evidence and data term per cell"},
                  {"labels", "Empty and solid cells"},
                  {"surfaces", "True floors and ceilings; absent: all lie at their levels", true},
                  {"lines", "Wall lines that the cells were cut with: names curved walls", true},
                  {"openings", "Doors and passages; absent: every wall stays closed", true}};
  stage.outputs = {{"ply", "Triangles, with kind, storey and region"},
                   {"obj", "Polygons, grouped per storey and kind"},
                   {"summary", "Storeys, rooms, areas, volumes, checks"},
                   {"rooms", "Storey and room of every cell"}};
  return stage;
}

// The mesh that failed its check is kept beside the model's place, for whoever looks into it.
std::filesystem::path rejected_path(std::filesystem::path path) {
  return path.replace_extension(".rejected.ply");
}

void body(StageRun& run, const ExtractParams& params) {
  const CellsFile cells = read_cells(run.input("cells"));
  const FaceWeights weights = read_weights(run.input("weights"), cells);
  const DataTerms terms = read_data_terms(run.input("terms"), cells);
  const Labels labels = read_labels(run.input("labels"), cells);
  std::vector<Opening> openings;
  if (run.has_input("openings")) {
    openings = read_openings(run.input("openings"), cells.payload_sha256).content.openings;
  }
  LevelSurfaces surfaces;
  if (run.has_input("surfaces")) {
    surfaces = read_surfaces(run.input("surfaces"), cells);
  }
  Model model = extract_model(cells.complex, labels, openings, params, surfaces);
  const std::filesystem::path rejected = rejected_path(run.output("ply"));
  if (!model.fault.empty()) {
    write_model_ply(rejected, model, cells.complex.frame);
    throw StageError(errors::kMeshInvalid, run.input("labels").string(),
                     "the model fails its check: " + model.fault,
                     "please report it with " + rejected.string() + " and the .h5 files beside the labels");
  }
  if (run.has_input("lines")) {
    model.curved_walls = find_curved_walls(read_wall_lines(run.input("lines")).content, cells.complex,
                                           labels.label, model.cell_rooms.storey);
  }
  list_unknown_spaces(cells.complex, labels, weights, terms, params, model);
  write_rooms(run.output("rooms"), model.cell_rooms, cells, run.provenance());
  write_model_ply(run.output("ply"), model, cells.complex.frame);
  write_model_obj(run.output("obj"), model, cells.complex.frame);
  write_summary(run.output("summary"), model, cells.complex, labels, run.provenance());
  std::filesystem::remove(rejected);
  run.count("storeys", static_cast<double>(model.storeys.size()));
  run.count("rooms", static_cast<double>(model.rooms.size()));
  run.count("unknown spaces", static_cast<double>(model.unknown_spaces.size()));
  run.count("curved walls", static_cast<double>(model.curved_walls.size()));
  run.count("openings", static_cast<double>(model.openings.size()));
  for (const std::string& refused : model.refused) {
    run.warn("opening " + refused + "; it stays closed");
  }
  if (model.put_back_m2 > 0) {
    std::array<char, 160> text;
    std::snprintf(
        text.data(), text.size(),
        "%.3f m2 of floors and ceilings lie at their levels: at their true surfaces the model would "
        "touch itself",
        model.put_back_m2);
    run.warn(text.data());
  }
  run.count("volume", model.empty_m3, "m^3");
  run.count("triangles", static_cast<double>(model.surface.mesh.triangles.size()));
  run.count("surfaces", static_cast<double>(model.surface.regions.size()));
}

}  // namespace

int main(int argc, char** argv) {
  ExtractParams params;
  return run_stage(argc, argv, info(), parameters(params), [&](StageRun& run) { body(run, params); });
}

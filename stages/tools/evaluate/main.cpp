// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "common/cli/run_stage.h"
#include "common/errors/codes.h"
#include "common/mesh/mesh_io.h"
#include "stages/tools/evaluate/comparable.h"
#include "stages/tools/evaluate/evaluate.h"
#include "stages/tools/evaluate/evaluate_io.h"
#include "stages/tools/evaluate/params.h"

namespace {

using namespace roomcut;
using namespace roomcut::evaluate;

StageInfo info() {
  StageInfo stage;
  stage.name = "evaluate";
  stage.revision = 4;
  stage.summary = "Scores a model against a truth mesh";
  stage.inputs = {
      {"model", "Mesh to judge: PLY, OFF or OBJ"},
      {"truth", "Closed mesh of the rooms' empty space: OFF, PLY or OBJ"},
      {"truth-json", "Rooms of the truth; without it every body is a room", true},
      {"cells", "Cells that the model was made of: explains what is wrong", true},
      {"labels", "Their labels; required with --cells", true},
      {"terms", "Their data terms: adds the evidence", true},
      {"surfaces", "True floors and ceilings of these labels: where the cells end", true},
      {"summary", "The model's summary.json: which of its walls are curved", true},
      {"cloud", "Scan that the model was made of: tells walls from doors up to the ceiling", true}};
  stage.outputs = {{"scores", "All scores"},
                   {"coloured", "The model coloured by its distance to the truth"},
                   {"picture", "The same as a picture"},
                   {"cells-out", "How much of every cell is empty in the truth; needs --cells", true}};
  return stage;
}

/// What --cells-out asks for; a file of an earlier run does not stay when there is nothing to write.
void write_cells_out(StageRun& run, const Scores& scores, const std::optional<LabelledCells>& cells) {
  const std::filesystem::path path = run.output("cells-out");
  if (path.empty()) {
    return;
  }
  if (cells && scores.explanation) {
    write_truth_cells(path, *scores.explanation, *cells, run.provenance());
    return;
  }
  std::error_code none;
  std::filesystem::remove(path, none);
  run.warn("--cells-out is not written: the model is not closed, so its cells are not compared");
}

void body(StageRun& run, const EvaluateParams& params) {
  if (!run.output("cells-out").empty() && run.input("cells").empty()) {
    throw StageError(errors::kUsage, "--cells-out", "there are no cells to compare with the truth",
                     "give --cells and --labels, those of 90_final, as well");
  }
  const TriangleMesh truth_file = read_mesh(run.input("truth"));
  const TriangleMesh model_file = read_mesh(run.input("model"));
  const Bounds3 box = bounds(truth_file);
  require_comparable({run.input("model").string(), bounds(model_file)}, {run.input("truth").string(), box});
  ComparedAxes axes{0.5 * (box.lo + box.hi)};
  std::optional<LabelledCells> cells;
  if (!run.input("cells").empty()) {
    cells = read_labelled_cells(run.input("cells"), run.input("labels"), run.input("terms"),
                                run.has_input("surfaces") ? run.input("surfaces") : "", axes);
  }
  TruthDescription described;
  if (run.has_input("truth-json")) {
    described = read_truth_description(run.input("truth-json"), axes);
  }
  std::optional<ScannedSurface> scanned;
  if (run.has_input("cloud")) {
    scanned = read_scanned_surface(run.input("cloud"), axes);
  }
  const TriangleMesh truth = prepared(truth_file, axes);
  const TriangleMesh model = prepared(model_file, axes);
  Scores scores = evaluate::evaluate(model, truth, described, params, cells ? &*cells : nullptr,
                                     scanned ? &*scanned : nullptr);
  if (run.has_input("summary")) {
    scores.arcs = score_arcs(described.arcs, read_curved_walls(run.input("summary"), axes));
  }
  if (scores.explanation) {
    for (Explanation::InventedSpace& space : scores.explanation->invented) {
      space.centre = axes.to_file(space.centre);
    }
  }
  const DistanceMesh coloured = measure_for_display(model, MeshTree(truth));
  write_distance_ply(run.output("coloured"), coloured, axes, params.colour_range_m);
  write_distance_png(run.output("picture"), coloured, params.colour_range_m);
  write_scores(run.output("scores"), scores, run.provenance());
  write_cells_out(run, scores, cells);
  run.chose("sample_spacing_m", scores.sample_spacing_m);
  if (!run.quiet()) {
    std::cout << scores_table(scores);
  }
}

}  // namespace

int main(int argc, char** argv) {
  EvaluateParams params;
  return run_stage(argc, argv, info(), parameters(params), [&](StageRun& run) { body(run, params); });
}

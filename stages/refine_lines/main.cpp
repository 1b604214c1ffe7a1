// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/cells_io.h"
#include "common/cli/run_stage.h"
#include "common/cloud/cloud_io.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/refine_lines/carried_layers.h"
#include "stages/refine_lines/one_sided.h"
#include "stages/refine_lines/params.h"
#include "stages/refine_lines/refine_lines.h"

namespace {

using namespace roomcut;
using namespace roomcut::refine_lines;

StageInfo info() {
  StageInfo stage;
  stage.name = "refine_lines";
  stage.revision = 11;
  stage.summary = "Refines the wall lines that carry a wall in the first cut, on raw points";
  stage.inputs = {{"lines", "Accepted wall lines"},
                  {"cells", "Cell complex of the first pass"},
                  {"weights", "Weights of its faces"},
                  {"labels", "Its labels"},
                  {"cloud", "Points"}};
  stage.outputs = {{"lines-out", "Refined wall lines"}};
  return stage;
}

void report(StageRun& run, const Refinement& refinement) {
  run.count("lines", static_cast<double>(refinement.lines.lines.size()));
  run.count("refined", refinement.refined);
  run.count("held", refinement.held);
  run.count("dropped", refinement.dropped);
  run.count("merged", refinement.merged);
  run.count("split off", refinement.split);
  run.count("bends", refinement.bends);
  run.count("curved walls", refinement.arcs);
  run.count("directions", refinement.classes);
  run.count("observations", refinement.observations);
  run.count("points", static_cast<double>(refinement.points));
  run.count("median shift", 1e3 * refinement.median_shift_m, "mm");
  run.count("largest shift", 1e3 * refinement.largest_shift_m, "mm");
  if (!refinement.converged) {
    run.warn("the common adjustment failed; every line keeps its own fit");
  }
}

void body(StageRun& run, const RefineLinesParams& params) {
  WallLinesFile lines = read_wall_lines(run.input("lines"));
  if (!params.enabled) {
    write_wall_lines(run.output("lines-out"), lines.content, run.provenance());
    run.count("lines", static_cast<double>(lines.content.lines.size()));
    return;
  }
  const CellsFile cells = read_cells(run.input("cells"));
  const Labels labels = read_labels(run.input("labels"), cells);
  const CloudReader cloud(run.input("cloud"));
  const FaceWeights weights = read_weights(run.input("weights"), cells);
  const std::vector<OneSidedWall> one_sided =
      find_one_sided(cells.complex, weights, labels.label, params.one_sided_m2);
  CarriedRuns carried = find_carried_runs(cells.complex, weights, labels.label);
  restrict_to_carried_layers(cells.complex, ids_of(one_sided), carried, lines.content);
  LineRefiner refiner(lines.content, cells.complex, labels.label, cloud.header().noise_m,
                      cloud.header().density, params, one_sided, carried);
  if (!params.band_m) {
    run.chose("band_m", refiner.band_m());
  }
  if (!params.merge_m) {
    run.chose("merge_m", refiner.merge_m());
  }
  if (!params.split_m) {
    run.chose("split_m", refiner.split_m());
  }
  Progress progress = run.progress("observing", cloud.header().points);
  cloud.for_each_tile([&](std::size_t, const CloudTile& tile) { refiner.add(tile); },
                      [&](std::uint64_t points) { progress.advance(points); });
  Refinement refinement = refiner.finish();
  const double thickness = usual_thickness(cells.complex, labels.label);
  run.count("unseen faces added", add_unseen_faces(refinement.one_sided, thickness, refinement.lines));
  run.count("usual thickness of a wall", 1e3 * thickness, "mm");
  write_wall_lines(run.output("lines-out"), refinement.lines, run.provenance());
  report(run, refinement);
}

}  // namespace

int main(int argc, char** argv) {
  RefineLinesParams params;
  return run_stage(argc, argv, info(), parameters(params), [&](StageRun& run) { body(run, params); });
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/cells_io.h"
#include "common/cli/run_stage.h"
#include "stages/graphcut/graphcut.h"

namespace {

using namespace roomcut;
using namespace roomcut::graphcut;

StageInfo info() {
  StageInfo stage;
  stage.name = "graphcut";
  stage.revision = 4;
  stage.summary = "Labels every cell empty, solid or unknown by exact minimum cuts";
  stage.inputs = {{"cells", "The cell complex"},
                  {"weights", "Coverage of its faces"},
                  {"terms", "Data term of its cells"}};
  stage.outputs = {{"labels-out", "Label, margin and trust of every cell"}};
  return stage;
}

void body(StageRun& run, const GraphcutParams& params) {
  const CellsFile cells = read_cells(run.input("cells"));
  const FaceWeights weights = read_weights(run.input("weights"), cells);
  const DataTerms terms = read_data_terms(run.input("terms"), cells);
  const Graphcut result = graphcut::graphcut(cells.complex, weights, terms, params);
  write_labels(run.output("labels-out"), result.labels, cells, run.provenance());

  if (result.cut_alone) {
    run.warn(
        "no space was seen well enough to be surely a room: none is called unknown, the cut alone decides");
  }
  run.count("cells", static_cast<double>(cells.complex.cells()));
  run.count("empty cells", static_cast<double>(result.empty_cells));
  run.count("empty", result.empty_m3, "m^3");
  run.count("of it unobserved", result.unobserved_empty_m3, "m^3");
  run.count("unknown", result.unknown_m3, "m^3");
  run.count("energy", result.labels.energy_m3, "m^3");
  run.count("data term", result.labels.data_m3, "m^3");
  run.count("surface term", result.labels.boundary_m3, "m^3");
  run.count("energy added by the unknown", result.unknown_added_m3, "m^3");
  run.count("non-manifold places in the cut", static_cast<double>(result.bad_places));
  run.count("labels changed by the repair", static_cast<double>(result.labels.repair_flips));
  run.count("energy added by the repair", result.repair_m3, "m^3");
}

}  // namespace

int main(int argc, char** argv) {
  GraphcutParams params;
  return run_stage(argc, argv, info(), parameters(params), [&](StageRun& run) { body(run, params); });
}

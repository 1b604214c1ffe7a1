// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/cells_io.h"
#include "common/cli/run_stage.h"
#include "stages/raycast/raycast.h"

namespace {

using namespace roomcut;
using namespace roomcut::raycast;

void body(StageRun& run, const RaycastParams& params) {
  const CellsFile cells = read_cells(run.input("cells"));
  const FaceWeights weights = read_weights(run.input("weights"), cells);
  const DataTerms terms = cast_rays(cells.complex, weights, params);
  write_data_terms(run.output("terms-out"), terms, cells, run.provenance());

  double empty = 0;
  double unclear = 0;
  for (std::size_t f = 0; f < cells.complex.faces(); ++f) {
    for (std::size_t k = 0; k < cells.complex.layers(); ++k) {
      const double volume = cells.complex.area(f) * cells.complex.height(k);
      const float beta = terms.beta[cells.complex.cell(f, k)];
      empty += beta > 0.5F ? volume : 0;
      unclear += beta > 0.3F && beta < 0.7F ? volume : 0;
    }
  }
  run.count("cells", static_cast<double>(terms.beta.size()));
  run.count("rays", static_cast<double>(terms.beta.size()) * params.rays);
  run.count("volume that the data call empty", empty, "m^3");
  run.count("volume in doubt (beta 0.3 to 0.7)", unclear, "m^3");
}

}  // namespace

int main(int argc, char** argv) {
  RaycastParams params;
  StageInfo info;
  info.name = "raycast";
  info.revision = 12;
  info.summary = "Gathers what speaks for each cell being empty or solid, by rays and by its own faces";
  info.inputs = {{"cells", "Cell complex"}, {"weights", "Weights of its faces"}};
  info.outputs = {{"terms-out", "Evidence and data term per cell"}};
  return run_stage(argc, argv, info, parameters(params), [&params](StageRun& run) { body(run, params); });
}

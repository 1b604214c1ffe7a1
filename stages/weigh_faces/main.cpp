// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/weigh_faces.h"

#include "common/cells/cells_io.h"
#include "common/cli/run_stage.h"
#include "common/cloud/cloud_io.h"

namespace {

using namespace roomcut;
using namespace roomcut::weigh_faces;

void report(StageRun& run, const FaceWeights& weights) {
  double on_walls = 0;
  double on_levels = 0;
  double inside = 0;
  double permanent = 0;
  for (const std::uint32_t n : weights.wall_points) on_walls += n;
  for (const std::uint32_t n : weights.level_points) on_levels += n;
  for (const std::uint32_t n : weights.cell_points) inside += n;
  for (const float w : weights.wall_omega) permanent += w > 0.5F ? 1 : 0;
  for (const float w : weights.level_omega) permanent += w > 0.5F ? 1 : 0;
  run.count("points on walls", on_walls);
  run.count("points on levels", on_levels);
  run.count("points inside cells", inside);
  run.count("faces covered by more than half", permanent);
}

void body(StageRun& run, const WeighFacesParams& params) {
  const CellsFile cells = read_cells(run.input("cells"));
  const CloudReader cloud(run.input("cloud"));
  FaceWeigher weigher(cells.complex, cloud.header(), params);
  if (!params.tau_m) {
    run.chose("tau_m", weigher.tolerances().bin / 2);
  }
  if (!params.wall_reach_m) {
    run.chose("wall_reach_m", weigher.tolerances().wall_reach);
  }
  if (!params.level_reach_m) {
    run.chose("level_reach_m", weigher.tolerances().level_reach);
  }
  Progress progress = run.progress("points", cloud.header().points);
  cloud.for_each_tile([&](std::size_t, const CloudTile& tile) { weigher.add(tile); },
                      [&](std::uint64_t points) { progress.advance(points); });
  FaceWeights weights = weigher.weigh();
  weights.stations = cloud.header().stations;
  write_weights(run.output("weights-out"), weights, cells, run.provenance());
  report(run, weights);
}

}  // namespace

int main(int argc, char** argv) {
  WeighFacesParams params;
  StageInfo info;
  info.name = "weigh_faces";
  info.revision = 10;
  info.summary =
      "Measures how far each face of the cell complex is covered by points, and which side of it is empty";
  info.inputs = {{"cells", "Cell complex"}, {"cloud", "Points in tiles"}};
  info.outputs = {{"weights-out", "Weights of the faces"}};
  return run_stage(argc, argv, info, parameters(params), [&params](StageRun& run) { body(run, params); });
}

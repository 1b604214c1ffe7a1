// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/weigh_faces.h"

#include "common/cells/cells_io.h"
#include "common/cli/run_stage.h"
#include "common/cloud/cloud_io.h"

namespace {

using namespace roomcut;
using namespace roomcut::weigh_faces;

ParameterTable parameters(WeighFacesParams& p) {
  return {
      auto_number("tau_m", p.tau_m, "m", 0.01, 0.5, "Half the edge of the bins in which coverage is counted.",
                  "0.6 x point spacing (a preferred number), 4 ... 15 cm"),
      auto_number("wall_reach_m", p.wall_reach_m, "m", 0.005, 0.5,
                  "Largest distance of a wall's points from its line.", "3 x noise, 4 ... 5.5 cm"),
      auto_number("level_reach_m", p.level_reach_m, "m", 0.005, 0.5,
                  "Largest distance of a floor's points from its level.",
                  "max(6 cm, 6 x noise), noise up to 5 cm"),
      angle("azimuth_deg", p.azimuth_rad, 1.0, 45.0,
            "Largest angle between a wall point's normal and its line's."),
      number("top_share", p.top_share, "1", 0.0, 1.0,
             "A wall also counts by this top share of its height alone, which furniture leaves free; 0 = "
             "never."),
      choice(
          "wall_bins", p.wall_bins, {"face", "edge"},
          "face: bins lie on a wall's face; edge: the paper's, along its edge in plan, whatever the height."),
      boolean("correct_density", p.correct_density,
              "Occupied bins also stand for those that a thin sample missed; false: bins are counted."),
      boolean("seen_through", p.seen_through,
              "Walls that were seen through the openings of another one lose coverage."),
      boolean("continue_walls", p.continue_walls,
              "Wall faces too small to be hit take the coverage of the face above or below."),
      boolean("slopes", p.slopes, "Points of sloped surfaces cover levels like ceilings."),
      boolean("sides", p.sides, "Find out which side of each face is empty; false: both alike, a half each."),
  };
}

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
  info.revision = 6;
  info.summary =
      "Measures how far each face of the cell complex is covered by points, and which side of it is empty";
  info.inputs = {{"cells", "Cell complex"}, {"cloud", "Points in tiles"}};
  info.outputs = {{"weights-out", "Weights of the faces"}};
  return run_stage(argc, argv, info, parameters(params), [&params](StageRun& run) { body(run, params); });
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/cells_io.h"
#include "common/cli/run_stage.h"
#include "common/cloud/cloud_io.h"
#include "common/openings/openings_io.h"
#include "stages/find_openings/find_openings.h"
#include "stages/find_openings/params.h"

namespace {

using namespace roomcut;
using namespace roomcut::find_openings;

StageInfo info() {
  StageInfo stage;
  stage.name = "find_openings";
  stage.revision = 4;
  stage.summary = "Finds doors and other passages in the walls between rooms";
  stage.inputs = {
      {"cells", "Cell complex of the second pass"}, {"labels", "Its labels"}, {"cloud", "Points"}};
  stage.outputs = {{"openings", "Doors and passages"}};
  return stage;
}

void body(StageRun& run, const FindOpeningsParams& params) {
  const CellsFile cells = read_cells(run.input("cells"));
  const Labels labels = read_labels(run.input("labels"), cells);
  Openings result{cells.complex.frame, cells.payload_sha256, {}};
  if (params.enabled) {
    const CloudReader cloud(run.input("cloud"));
    const OpeningTolerances tolerances =
        opening_tolerances(params, cloud.header().noise_m, cloud.header().density);
    if (!params.margin_m) {
      run.chose("margin_m", tolerances.margin_m);
    }
    const std::vector<RoomWall> walls =
        find_room_walls(cells.complex, labels.label, params.max_thickness_m, kWidestGap_m, kColumn_m);
    WallEvidence evidence(walls, cells.complex.levels, {tolerances.margin_m, tolerances.row_m});
    Progress progress = run.progress("observing", cloud.header().points);
    cloud.for_each_tile([&](std::size_t, const CloudTile& tile) { evidence.add(tile); },
                        [&](std::uint64_t points) { progress.advance(points); });
    result.openings = find_openings::find_openings(cells.complex, walls, evidence, params, tolerances);
    run.count("walls between rooms", static_cast<double>(walls.size()));
  }
  write_openings(run.output("openings"), result, run.provenance());
  run.count("openings", static_cast<double>(result.openings.size()));
}

}  // namespace

int main(int argc, char** argv) {
  FindOpeningsParams params;
  return run_stage(argc, argv, info(), parameters(params), [&](StageRun& run) { body(run, params); });
}

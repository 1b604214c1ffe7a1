// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>
#include <stdexcept>

#include "common/cells/cells_io.h"
#include "common/cli/run_stage.h"
#include "common/sloped_planes/planes_io.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/partition/partition.h"

namespace {

using namespace roomcut;
using namespace roomcut::partition;

StageInfo info() {
  StageInfo stage;
  stage.name = "partition";
  stage.revision = 4;
  stage.summary = "Cuts the plan into convex cells along the wall lines and stacks them between the levels";
  stage.inputs = {{"lines", "Accepted (or refined) wall lines"},
                  {"planes", "Levels of floors and ceilings, and sloped planes"}};
  stage.outputs = {{"cells-out", "The cell complex"}};
  return stage;
}

void body(StageRun& run, const PartitionParams& params) {
  const WallLinesFile lines = read_wall_lines(run.input("lines"));
  const AcceptedPlanes planes = read_planes_file(run.input("planes")).content;
  std::vector<double> levels;
  Slopes slopes;
  for (const PlaneFeature& feature : planes.planes) {
    slopes.planes.push_back(feature.plane);
  }
  for (const Level& level : planes.levels) {
    levels.push_back(level.z);
    slopes.steps.push_back(level.step ? 1 : 0);
  }
  const Partition result = partition::partition(lines.content, levels, params, slopes);
  const CellComplex& complex = result.complex;
  const std::string violation = find_violation(complex);
  if (!violation.empty()) {
    throw std::logic_error("partition made an invalid complex: " + violation);
  }
  write_cells(run.output("cells-out"), complex, run.provenance());

  run.count("lines", static_cast<double>(lines.content.lines.size()));
  run.count("creases of sloped planes",
            static_cast<double>(complex.lines.size() - lines.content.lines.size()));
  run.count("lines without an edge of their own", static_cast<double>(result.without_edge.size()));
  run.count("plan faces before pruning", static_cast<double>(result.faces_before_pruning));
  run.count("plan faces", static_cast<double>(complex.faces()));
  run.count("plan edges", static_cast<double>(complex.edges.size()));
  run.count("layers", static_cast<double>(complex.layers()));
  run.count("cells", static_cast<double>(complex.cells()));
}

}  // namespace

int main(int argc, char** argv) {
  PartitionParams params;
  return run_stage(argc, argv, info(), parameters(params), [&](StageRun& run) { body(run, params); });
}

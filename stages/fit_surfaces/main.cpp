// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "common/cells/cells_io.h"
#include "common/cells/surfaces_io.h"
#include "common/cli/run_stage.h"
#include "common/cloud/cloud_io.h"
#include "common/sloped_planes/planes_io.h"
#include "stages/fit_surfaces/fit_surfaces.h"
#include "stages/fit_surfaces/params.h"

namespace {

using namespace roomcut;
using namespace roomcut::fit_surfaces;

StageInfo info() {
  StageInfo stage;
  stage.name = "fit_surfaces";
  stage.revision = 2;
  stage.summary = "Gives every floor and ceiling its own height or plane, on raw points";
  stage.inputs = {{"cells", "Cell complex of the second pass"},
                  {"labels", "Its labels"},
                  {"planes", "Its sloped planes: which are locked"},
                  {"cloud", "Points"}};
  stage.outputs = {{"surfaces-out", "True surfaces of floors and ceilings"}};
  return stage;
}

void report(StageRun& run, const FittedSurfaces& fitted) {
  run.count("floors and ceilings", static_cast<double>(fitted.regions));
  run.count("surfaces", static_cast<double>(fitted.surfaces.surfaces.size()));
  run.count("tilted", static_cast<double>(fitted.tilted));
  run.count("split off", static_cast<double>(fitted.split));
  run.count("left at their level", static_cast<double>(fitted.unseen));
  run.count("median shift", 1e3 * fitted.median_shift_m, "mm");
  run.count("largest shift", 1e3 * fitted.largest_shift_m, "mm");
  run.count("roughness", 1e3 * std::sqrt(fitted.roughness.variance_m2), "mm");
  run.count("patches that err as one", fitted.roughness.patches);
  run.count("largest deviation", 1e3 * fitted.largest_rms_m, "mm");
}

/// Per plane of the complex, which has them in the order of the file: whether it is locked.
std::vector<std::uint8_t> locked_planes(const AcceptedPlanes& accepted) {
  std::vector<std::uint8_t> locked;
  for (const PlaneFeature& feature : accepted.planes) {
    locked.push_back(feature.locked ? 1 : 0);
  }
  return locked;
}

void body(StageRun& run, const FitSurfacesParams& params) {
  const CellsFile cells = read_cells(run.input("cells"));
  const Labels labels = read_labels(run.input("labels"), cells);
  FittedSurfaces fitted;
  fitted.surfaces.of_face.assign(cells.complex.faces() * cells.complex.levels.size(), -1);
  if (params.enabled) {
    const CloudReader cloud(run.input("cloud"));
    SurfaceFitter fitter(cells.complex, labels.label, cloud.header(), params);
    if (!params.reach_m) {
      run.chose("reach_m", fitter.reach_m());
    }
    Progress progress = run.progress("observing", cloud.header().points);
    cloud.for_each_tile([&](std::size_t, const CloudTile& tile) { fitter.add(tile); },
                        [&](std::uint64_t points) { progress.advance(points); });
    fitted = fitter.fit(locked_planes(read_planes_file(run.input("planes")).content));
    run.count("points", static_cast<double>(fitter.points()));
  }
  write_surfaces(run.output("surfaces-out"), fitted.surfaces, cells, run.provenance());
  report(run, fitted);
}

}  // namespace

int main(int argc, char** argv) {
  FitSurfacesParams params;
  return run_stage(argc, argv, info(), parameters(params), [&](StageRun& run) { body(run, params); });
}

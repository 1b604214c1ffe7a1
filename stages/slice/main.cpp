// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include "common/cli/run_stage.h"
#include "common/cloud/cloud_io.h"
#include "common/slices/slices_io.h"
#include "stages/slice/slice.h"
#include "stages/slice/unit_question.h"
#include "stages/slice/vault_warning.h"

namespace {

using namespace roomcut;
using namespace roomcut::slice;

void report(StageRun& run, const SliceResult& result) {
  for (const SliceChoice& choice : result.choices) run.chose(choice.parameter, choice.value);
  const Slices& slices = result.slices;
  std::size_t cells = 0;
  for (const OccupancyGrid& grid : slices.wall_slices) cells += grid.size();
  for (const Level& level : slices.levels) {
    run.count(level.cap ? "level (cap)" : level.step ? "level (step of a slope)" : "level", level.z, "m");
  }
  for (const SlopedPlane& plane : slices.planes) {
    run.count(plane.ceiling ? "sloped ceiling" : "sloped floor",
              std::atan(plane.gradient.norm()) * 180 / std::numbers::pi, "deg");
  }
  run.count("levels", static_cast<double>(slices.levels.size()));
  run.count("surfaces too small for a level", static_cast<double>(result.rejected.size()));
  run.count("wall cells", static_cast<double>(cells));
  double open_m = 0;
  for (const OpenEdge& edge : result.open_edges) open_m += edge.length_m();
  run.count("open edges of ceilings", open_m, "m");
  if (open_m > 0) {
    run.warn("ceilings end in the open along " + std::to_string(std::lround(open_m)) +
             " m without a wall, as at glass or an open side; what was seen beyond may be taken for a room");
  }
  if (const std::string question = unit_question(slices); !question.empty()) run.warn(question);
  if (const std::string vault = vault_warning(slices); !vault.empty()) run.warn(vault);
}

}  // namespace

int main(int argc, char** argv) {
  SliceParams params;
  StageInfo info{"slice",
                 8,
                 "Finds floors and ceilings in the height histogram and the wall evidence between them.",
                 {{"cloud", "points in tiles, from ingest"}},
                 {{"slices", "levels, sloped planes, histogram, wall slices"}},
                 {}};
  return run_stage(argc, argv, info, parameters(params), [&params](StageRun& run) {
    const CloudReader cloud(run.input("cloud"));
    constexpr std::uint64_t kPasses = 2;
    Progress progress = run.progress("points", kPasses * cloud.header().points);
    const TileSource tiles = [&](const TileVisitor& visit) {
      cloud.for_each_tile(visit, [&](std::uint64_t points) { progress.advance(points); });
    };
    const SliceResult result = slice_cloud(cloud.header(), tiles, params);
    write_slices(run.output("slices"), result.slices, run.provenance());
    report(run, result);
  });
}

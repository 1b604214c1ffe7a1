// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/run_stage.h"
#include "common/cloud/cloud_io.h"
#include "common/slices/slices_io.h"
#include "stages/slice/slice.h"
#include "stages/slice/unit_question.h"

namespace {

using namespace roomcut;
using namespace roomcut::slice;

ParameterTable parameters(SliceParams& p) {
  return {
      auto_number("bandwidth_m", p.bandwidth_m, "m", 0.002, 0.5,
                  "Bandwidth of the mean shift that finds the peaks of the height histogram.",
                  "max(7 mm, 1.5 x noise)"),
      auto_number("raster_m", p.raster_m, "m", 0.02, 1.0,
                  "Edge of the plan raster in which horizontal surfaces are connected.",
                  "2.5 x point spacing (a preferred number), 10 ... 40 cm"),
      auto_number("min_component_m2", p.min_component_m2, "m^2", 0.1, 100.0,
                  "Smallest connected horizontal surface that makes a level.",
                  "4 m^2; half of the largest surface if that is less"),
      auto_number("tau_m", p.tau_m, "m", 0.01, 0.5,
                  "Edge of the occupancy cells of a wall slice (the paper's tau).",
                  "3 points per cell, 2 x noise (a preferred number), 4 ... 10 cm"),
      boolean("by_area", p.by_area,
              "Horizontal points weigh the area for which they stand; false: all the same."),
      boolean("drift", p.drift, "Surfaces that drift up and down get a wider bandwidth."),
      boolean("join_modes", p.join_modes, "Peaks that are nearly one become one level."),
      boolean("connected", p.connected,
              "A level needs min_component_m2 in one piece; false: in all, wherever it lies."),
      boolean("furniture", p.furniture, "Tables and beds are told from floors, and are no levels."),
      boolean("upright_only", p.upright_only,
              "Only points of walls and points without a plane count in wall slices; false: all points."),
      number("cap_reach_m", p.cap_reach_m, "m", 0.05, 1000.0,
             "Walls that go on farther past the last level get a cap there."),
      number("step_m", p.step_m, "m", 0.0, 5.0,
             "Distance of the levels that stand for a sloped roof or ramp; 0 = none."),
      number("tall_slice_m", p.tall_slice_m, "m", 0.0, 100.0,
             "Wall slices higher than this count evidence in their top part only."),
      number("evidence_share", p.evidence_share, "1", 0.05, 1.0,
             "That top part, as a share of the slice's height."),
  };
}

void report(StageRun& run, const SliceResult& result) {
  for (const SliceChoice& choice : result.choices) run.chose(choice.parameter, choice.value);
  const Slices& slices = result.slices;
  std::size_t cells = 0;
  for (const OccupancyGrid& grid : slices.wall_slices) cells += grid.size();
  for (const Level& level : slices.levels) {
    run.count(level.cap ? "level (cap)" : level.step ? "level (step of a slope)" : "level", level.z, "m");
  }
  run.count("levels", static_cast<double>(slices.levels.size()));
  run.count("surfaces too small for a level", static_cast<double>(result.rejected.size()));
  run.count("wall cells", static_cast<double>(cells));
  if (const std::string question = unit_question(slices); !question.empty()) run.warn(question);
}

}  // namespace

int main(int argc, char** argv) {
  SliceParams params;
  StageInfo info{"slice",
                 4,
                 "Finds floors and ceilings in the height histogram and the wall evidence between them.",
                 {{"cloud", "points in tiles, from ingest"}},
                 {{"slices", "levels, histogram, wall slices"}},
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/run_stage.h"
#include "stages/tools/synthesize/params.h"
#include "stages/tools/synthesize/scene_json.h"
#include "stages/tools/synthesize/scene_limits.h"
#include "stages/tools/synthesize/synthesize_io.h"

namespace {

using namespace roomcut;
using namespace roomcut::synthesize;

void override_scene(const SynthesizeParams& params, Scene& scene) {
  if (params.points) scene.sampling.points = static_cast<std::uint64_t>(*params.points);
  if (params.seed) scene.seed = static_cast<std::uint64_t>(*params.seed);
  if (params.noise_m) scene.noise_m = *params.noise_m;
}

/// The Python environment and the encoders lie beside the folder of the programs.
std::filesystem::path build_folder() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path().parent_path();
}

void run(StageRun& stage, const SynthesizeParams& params) {
  Scene scene = read_scene(stage.input("scene"));
  override_scene(params, scene);
  check_limits(scene);
  const Building building = place(scene);
  const TriangleMesh truth = make_truth(scene, building);
  const Surfaces surfaces(scene, building, truth);
  const auto source = make_source(scene, building, surfaces);
  Progress progress = stage.progress("points", source->expected_points());
  const std::uint64_t points = write_scan(
      stage.output("scan-out"), scene, *source, {stage.option("e57") == "spherical", build_folder()},
      stage.threads(), [&](std::uint64_t amount) { progress.advance(amount); });
  write_truth(stage.output("truth-out"), scene, building, truth);
  write_truth_json(stage.output("truth-json"), scene, building, truth, points, stage.provenance());
  stage.count("points", static_cast<double>(points));
  stage.count("rooms", static_cast<double>(scene.rooms.size() * copies(scene)));
  stage.count("volume", volume(truth) * static_cast<double>(copies(scene)), "m^3");
  stage.count("surface", surface_area(truth) * static_cast<double>(copies(scene)), "m^2");
}

}  // namespace

int main(int argc, char** argv) {
  StageInfo info;
  info.name = "synthesize";
  info.revision = 1;
  info.summary =
      "Makes a building from a short JSON file: a scan with noise, and its exact, closed truth mesh.";
  info.inputs = {{"scene", "scene file (schemas/scene.md)"}};
  info.outputs = {{"scan-out", "the scan, in the format of its name: .ply, .ptx, .e57, .las, .laz"},
                  {"truth-out", "the truth: closed triangle mesh, normals into the wall"},
                  {"truth-json", "rooms, walls, openings, scanner positions"}};
  info.options = {{"e57", "cartesian", "how an E57 file holds its points", {"cartesian", "spherical"}}};
  SynthesizeParams params;
  return run_stage(argc, argv, info, parameters(params), [&](StageRun& stage) { run(stage, params); });
}

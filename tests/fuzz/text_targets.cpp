// SPDX-License-Identifier: GPL-3.0-or-later
// pipeline.yaml, meshes, scenes, stamps.
#include <array>
#include <nlohmann/json.hpp>

#include "common/mesh/mesh_io.h"
#include "common/params/params.h"
#include "common/rerun/stamp.h"
#include "stages/tools/synthesize/scene_json.h"
#include "tests/fuzz/target.h"

namespace roomcut::fuzz {
using namespace roomcut::synthesize;

namespace {

void pipeline_yaml(std::string_view bytes) {
  double mu = 0.3;
  int count = 3;
  ParameterTable table = {number("mu_m", mu, "m", 0.01, 5.0, "A length."),
                          integer("count", count, "1", 1, 9, "A count.")};
  const PrivateFile file(bytes, ".yaml");
  load_yaml(file.path(), "graphcut", table);
}

void mesh_off(std::string_view bytes) {
  parse_mesh(bytes, "mesh.off");
}
void mesh_ply(std::string_view bytes) {
  parse_mesh(bytes, "mesh.ply");
}
void mesh_obj(std::string_view bytes) {
  parse_mesh(bytes, "mesh.obj");
}

void scene(std::string_view bytes) {
  const PrivateFile file(bytes, ".json");
  read_scene(file.path());
}

void stamp(std::string_view bytes) {
  const PrivateFile file(bytes);
  read_stamp(file.path());
}

constexpr std::array kTargets{Target{"pipeline_yaml", Mutation::kBytes, pipeline_yaml, ""},
                              Target{"mesh_off", Mutation::kBytes, mesh_off, ""},
                              Target{"mesh_ply", Mutation::kBytes, mesh_ply, ""},
                              Target{"mesh_obj", Mutation::kBytes, mesh_obj, ""},
                              Target{"scene", Mutation::kJson, scene, "scene.json"},
                              Target{"stamp", Mutation::kBytes, stamp, ""}};

}  // namespace

std::span<const Target> text_targets() {
  return kTargets;
}

}  // namespace roomcut::fuzz

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "stages/tools/synthesize/sample.h"
#include "stages/tools/synthesize/scene_json.h"
#include "stages/tools/synthesize/truth.h"

namespace roomcut::test {
using namespace roomcut::synthesize;

/// A closed room of 4 x 3 x 2.5 m; `more` is merged into the scene.
inline Scene box_scene(const nlohmann::json& more = nlohmann::json::object()) {
  nlohmann::json scene = nlohmann::json::parse(R"({
    "name": "box", "noise_m": 0,
    "storeys": [{"floor": 0, "ceiling": 2.5, "rooms": [{"name": "a", "polygon": [[0,0],[4,0],[4,3],[0,3]]}]}]})");
  scene.update(more);
  return scene_from_json(scene, "box");
}

/// Two rooms of 4 x 3 and 2 x 3 m, 0.2 m of wall between them, a door of 0.8 x 2 m.
inline nlohmann::json two_rooms_json() {
  return nlohmann::json::parse(R"({
    "name": "two", "noise_m": 0,
    "storeys": [{"floor": 0, "ceiling": 2.5, "rooms": [
      {"name": "a", "polygon": [[0,0],[4,0],[4,3],[0,3]]},
      {"name": "b", "polygon": [[4.2,0],[6.2,0],[6.2,3],[4.2,3]], "floor": 0.1}]}],
    "doors": [{"between": ["a", "b"], "at": [4.1, 1.5], "width": 0.8, "height": 2.0}]})");
}

inline std::vector<float> all_points(const Scene& scene) {
  const Building building = place(scene);
  const TriangleMesh truth = make_truth(scene, building);
  const Surfaces surfaces(scene, building, truth);
  const auto source = make_source(scene, building, surfaces);
  std::vector<float> xyz;
  for (std::uint64_t b = 0; b < source->blocks(); ++b) source->make(b, xyz);
  return xyz;
}

/// Distance of p to the border of the box [lo, hi], for p near it.
inline double box_distance(const Vec3& p, const Vec3& lo, const Vec3& hi) {
  const Vec3 outside = (lo - p).cwiseMax(p - hi).cwiseMax(0.0);
  if (outside.norm() > 0) return outside.norm();
  return (p - lo).cwiseMin(hi - p).minCoeff();
}

}  // namespace roomcut::test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/errors/error.h"
#include "stages/tools/synthesize/building.h"

namespace roomcut::synthesize {

/// The plan of the union of prisms: a triangulation of the plane in which every triangle lies in one region,
/// and every region is either empty or solid in each layer between two neighbouring heights.
struct PlanUnion {
  std::vector<double> heights;  ///< ascending; layer k lies between heights k and k + 1
  std::vector<Vec2> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counter-clockwise
  std::vector<std::int32_t> triangle_region;
  struct Edge {
    std::int32_t v0, v1;
    std::int32_t left, right;  ///< regions
  };
  std::vector<Edge> edges;               ///< between different regions
  std::vector<std::vector<char>> empty;  ///< per region and layer; region 0 is solid in all

  bool is_empty(std::int32_t region, std::ptrdiff_t layer) const {
    return layer >= 0 && layer < static_cast<std::ptrdiff_t>(heights.size()) - 1 && empty[region][layer] != 0;
  }
};

/// Overlays the prisms' plans (corners within 1 µm are one), labels each piece, drops the borders that
/// separate nothing, and triangulates what is left. Problems of the scene (see make_truth) are appended to
/// `problems`.
PlanUnion unite(const Scene& scene, const Building& building, std::vector<Problem>& problems);

}  // namespace roomcut::synthesize

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/mesh/mesh_tree.h"

namespace roomcut::evaluate {

/// The model cut into small triangles with the distance to the truth at each corner (paper, Figure 4).
struct DistanceMesh {
  TriangleMesh mesh;               ///< the same surface, with T-junctions: made for looking only
  std::vector<double> distance_m;  ///< per vertex
};

/// Halves the model's triangles at their longest sides until no side is longer than about 1/200 of the root
/// of the surface's area (at least 5 cm), and measures the corners. Parallel.
DistanceMesh measure_for_display(const TriangleMesh& model, const MeshTree& truth);

}  // namespace roomcut::evaluate

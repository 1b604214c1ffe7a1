// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/mesh_tree.h"
#include "common/mesh/triangle_mesh.h"

namespace roomcut::report {

/// Points of the scan as the page holds them: few bytes each, exact enough to be looked at.
struct PagePoints {
  Vec3 low{0, 0, 0};                  ///< corner of their box, local metres
  Vec3 step{0, 0, 0};                 ///< metres per unit of a coordinate, per axis
  std::vector<std::uint16_t> xyz;     ///< 3 per point
  std::vector<std::uint8_t> surface;  ///< SurfaceClass of each
  /// Distance from the model in steps of kDistanceStep_m, 255 = farther than the steps reach; empty without
  /// a model.
  std::vector<std::uint8_t> distance;
};

inline constexpr double kDistanceStep_m = 0.001;  ///< of PagePoints::distance

/// A point with the class of the surface around it.
struct ThinPoint {
  Vec3 at;
  std::uint8_t surface;
};

/// The triangle of the model (local metres) nearest to each point, as far as 255 steps.
std::vector<MeshTree::Hit> nearest_of_model(const std::vector<ThinPoint>& points, const TriangleMesh& model);

/// Packs points with what nearest_of_model() says of them; `nearest` is empty without a model. Order is kept.
PagePoints pack_points(const std::vector<ThinPoint>& points, const std::vector<MeshTree::Hit>& nearest);

/// Per surface region of the model the root of the mean squared distance of the points whose nearest triangle
/// lies in it and that are no farther than 254 steps [m]; NaN where there are none. `regions` is the number
/// of regions.
std::vector<float> region_distances(const std::vector<MeshTree::Hit>& nearest, const TriangleMesh& model,
                                    std::size_t regions);

}  // namespace roomcut::report

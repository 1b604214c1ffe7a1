// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "stages/tools/synthesize/surfaces.h"

namespace roomcut::synthesize {

/// Bounding volume hierarchy over triangles (binned surface area heuristic): the nearest hit of a ray.
class Bvh {
 public:
  explicit Bvh(const std::vector<SurfaceTriangle>& triangles);

  struct Hit {
    double distance = std::numeric_limits<double>::infinity();  ///< [m]
    std::int32_t triangle = -1;                                 ///< -1 = nothing hit
  };
  /// `direction` has unit length; hits nearer than 1 µm are ignored. Thread-safe.
  Hit first_hit(const Vec3& origin, const Vec3& direction, double max_distance) const;

 private:
  struct Node {
    float lo[3], hi[3];
    std::int32_t first = 0;  ///< leaf: first of its triangles; inner node: right child (the left one follows)
    std::int32_t count = 0;  ///< 0 = inner node
  };
  struct Build;
  void build(Build& data, std::int32_t begin, std::int32_t end);

  const std::vector<SurfaceTriangle>& triangles_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
};

}  // namespace roomcut::synthesize

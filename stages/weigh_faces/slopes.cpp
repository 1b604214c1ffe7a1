// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/slopes.h"

namespace roomcut::weigh_faces {

void cover_risers(const CellComplex& complex, FaceWeights& weights) {
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const CellComplex::Edge& edge = complex.edges[e];
    if (edge.line < 0 || complex.on_wall_line(edge)) {
      continue;
    }
    const CellComplex::Line& crease = complex.lines[static_cast<std::size_t>(edge.line)];
    const SlopedPlane& plane = complex.planes[static_cast<std::size_t>(crease.plane)];
    const auto left = static_cast<std::size_t>(edge.left);
    const auto right = static_cast<std::size_t>(edge.right);
    const bool uphill_left = plane.height(complex.centroid(left)) > plane.height(complex.centroid(right));
    for (const std::int32_t layer : crease.layers) {
      const auto k = static_cast<std::size_t>(layer);
      // The upper tread lies uphill. Beneath a ceiling the space uphill is the empty one, over a floor the
      // other.
      const float omega = 0.5F * (weights.level_omega[complex.level_face(uphill_left ? left : right, k + 1)] +
                                  weights.level_omega[complex.level_face(uphill_left ? right : left, k)]);
      const std::size_t w = complex.wall_face(e, k);
      const bool empty_left = uphill_left == plane.ceiling;
      weights.wall_omega[w] = omega;
      weights.wall_left[w] = empty_left ? omega : 0;
      weights.wall_right[w] = empty_left ? 0 : omega;
    }
  }
}

}  // namespace roomcut::weigh_faces

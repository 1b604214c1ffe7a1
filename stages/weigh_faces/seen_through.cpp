// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/seen_through.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/cells/plan_walk.h"

namespace roomcut::weigh_faces {
namespace {

constexpr double kDeepest = 0.6;    // [m] thickness of a facade
constexpr double kSparser = 0.3;    // points per covered area, of that of the wall in front
constexpr double kParallel = 0.95;  // cosine

/// Points per covered area; 0 without points.
double covered_density(const CellComplex& complex, const FaceWeights& weights, std::size_t edge,
                       std::size_t layer) {
  const std::size_t w = complex.wall_face(edge, layer);
  const double covered = weights.wall_omega[w] * complex.length(edge) * complex.height(layer);
  return covered > 0 ? weights.wall_points[w] / covered : 0;
}

Vec2 direction(const CellComplex& complex, std::size_t edge) {
  const CellComplex::Edge& e = complex.edges[edge];
  return (complex.vertices[static_cast<std::size_t>(e.v1)] - complex.vertices[static_cast<std::size_t>(e.v0)])
      .normalized();
}

/// The densest face that looks the same way as this one, between it and the room that it was seen from.
double density_in_front(const CellComplex& complex, const FaceWeights& weights, std::size_t edge,
                        std::size_t layer, bool front_is_left) {
  double densest = 0;
  const Vec2 along = direction(complex, edge);
  walk_beside(complex, edge, front_is_left, kDeepest, [&](std::size_t other, bool from_left) {
    if (std::abs(direction(complex, other).dot(along)) < kParallel) {
      return;
    }
    const std::size_t w = complex.wall_face(other, layer);
    // The way meets the other face from its back: its front is on the far side.
    if (weights.wall_side(w) == (from_left ? FaceSide::kRight : FaceSide::kLeft)) {
      densest = std::max(densest, covered_density(complex, weights, other, layer));
    }
  });
  return densest;
}

}  // namespace

void discount_seen_through(const CellComplex& complex, FaceWeights& weights) {
  std::vector<float> factor(weights.wall_omega.size(), 1.0F);
  for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
    for (std::size_t edge = 0; edge < complex.edges.size(); ++edge) {
      const std::size_t w = complex.wall_face(edge, layer);
      const FaceSide side = weights.wall_side(w);
      if (side == FaceSide::kUnclear) {
        continue;
      }
      const double expected =
          kSparser * density_in_front(complex, weights, edge, layer, side == FaceSide::kLeft);
      const double own = covered_density(complex, weights, edge, layer);
      if (own < expected) {
        factor[w] = static_cast<float>(own / expected);
      }
    }
  }
  for (std::size_t w = 0; w < factor.size(); ++w) {
    weights.wall_omega[w] *= factor[w];
    weights.wall_left[w] *= factor[w];
    weights.wall_right[w] *= factor[w];
  }
}

}  // namespace roomcut::weigh_faces

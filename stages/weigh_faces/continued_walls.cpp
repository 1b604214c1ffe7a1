// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/continued_walls.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace roomcut::weigh_faces {
namespace {

constexpr std::uint32_t kFewestPoints = 10;  // of the neighbour, to know its density
constexpr double kWeight = 3;                // points

/// Coverage that the face in layer `to` takes from the one in layer `from`; 0 for none.
float continued(const CellComplex& complex, const FaceWeights& weights, std::size_t edge, std::size_t from,
                std::size_t to) {
  const std::size_t w = complex.wall_face(edge, from);
  const float omega = weights.wall_omega[w];
  const FaceSide side = weights.wall_side(w);
  if (!weights.is_wall(w) || weights.wall_points[w] < kFewestPoints || side == FaceSide::kUnclear) {
    return 0;
  }
  const CellComplex::Edge& e = complex.edges[edge];
  const std::int32_t empty = side == FaceSide::kLeft ? e.left : e.right;
  // Where the room ends at a floor or ceiling, so does the wall.
  if (empty < 0 ||
      weights.is_level(complex.level_face(static_cast<std::size_t>(empty), std::max(from, to)))) {
    return 0;
  }
  const double expected =
      weights.wall_points[w] * complex.height(to) / (static_cast<double>(omega) * complex.height(from));
  return static_cast<float>(omega * kWeight / (kWeight + expected));
}

}  // namespace

void continue_walls(const CellComplex& complex, FaceWeights& weights) {
  const std::vector<float>& own = weights.wall_omega;
  struct Continued {
    std::size_t face;
    float omega, left;
  };
  std::vector<Continued> all;
  for (std::size_t edge = 0; edge < complex.edges.size(); ++edge) {
    const std::int32_t line = complex.edges[edge].line;
    for (std::size_t k = 0; line >= 0 && k < complex.layers(); ++k) {
      if (!complex.lines[static_cast<std::size_t>(line)].carries(k)) {
        continue;
      }
      Continued best{complex.wall_face(edge, k), own[complex.wall_face(edge, k)], 0};
      bool found = false;
      const auto ask = [&](std::size_t from) {
        if (const float omega = continued(complex, weights, edge, from, k); omega > best.omega) {
          best.omega = omega;
          best.left =
              omega * weights.wall_left[complex.wall_face(edge, from)] / own[complex.wall_face(edge, from)];
          found = true;
        }
      };
      if (k > 0) ask(k - 1);
      if (k + 1 < complex.layers()) ask(k + 1);
      if (found) all.push_back(best);
    }
  }
  for (const Continued& c : all) {
    weights.wall_omega[c.face] = c.omega;
    weights.wall_left[c.face] = c.left;
    weights.wall_right[c.face] = c.omega - c.left;
  }
}

}  // namespace roomcut::weigh_faces

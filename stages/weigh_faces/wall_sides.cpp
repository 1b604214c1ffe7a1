// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/wall_sides.h"

#include <cmath>
#include <limits>
#include <vector>

namespace roomcut {
namespace {

constexpr double kSeen = 0.15;      // coverage of a floor or ceiling on either side: enough to ask
constexpr double kContinues = 0.3;  // coverage with which a wall goes on into the next layer
constexpr double kPrior = 0.1;      // coverage below which neither side is believed
constexpr double kLevelWeight = 5;  // log-odds of a floor that is whole on one side and missing on the other
constexpr double kStripWeight = 5;  // the same for the strips
constexpr double kStripPrior = 2;   // columns

struct Exit {
  std::int32_t edge = -1;
  double distance = std::numeric_limits<double>::infinity();
};

/// Where a straight way from `start`, which entered the face by edge `came_by`, leaves it again.
Exit exit_of(const CellComplex& complex, std::size_t face, const Vec2& start, const Vec2& to,
             std::int32_t came_by) {
  Exit exit;
  const auto begin = static_cast<std::size_t>(complex.face_offset[face]);
  const auto end = static_cast<std::size_t>(complex.face_offset[face + 1]);
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t next = i + 1 < end ? i + 1 : begin;
    const Vec2& a = complex.vertices[static_cast<std::size_t>(complex.face_vertex[i])];
    const Vec2 along =
        (complex.vertices[static_cast<std::size_t>(complex.face_vertex[next])] - a).normalized();
    const Vec2 outward(along.y(), -along.x());
    const double speed = outward.dot(to);
    if (complex.face_edge[i] == came_by || speed <= 1e-9) {
      continue;
    }
    const double distance = outward.dot(a - start) / speed;
    if (distance < exit.distance) {
      exit = {complex.face_edge[i], distance};
    }
  }
  return exit;
}

}  // namespace

std::int32_t face_beside(const CellComplex& complex, std::size_t edge, bool left, double distance_m) {
  const CellComplex::Edge& e = complex.edges[edge];
  const Vec2& a = complex.vertices[static_cast<std::size_t>(e.v0)];
  const Vec2 along = (complex.vertices[static_cast<std::size_t>(e.v1)] - a);
  const Vec2 start = a + 0.5 * along;
  const Vec2 to = (left ? 1 : -1) * Vec2(-along.y(), along.x()).normalized();
  std::int32_t face = left ? e.left : e.right;
  std::int32_t came_by = static_cast<std::int32_t>(edge);
  while (face >= 0) {
    const Exit exit = exit_of(complex, static_cast<std::size_t>(face), start, to, came_by);
    if (exit.edge < 0 || exit.distance >= distance_m) {
      return face;
    }
    const CellComplex::Edge& crossed = complex.edges[static_cast<std::size_t>(exit.edge)];
    face = crossed.left == face ? crossed.right : crossed.left;
    came_by = exit.edge;
  }
  return face;
}

double left_probability(const CellComplex& complex, const FaceWeights& weights, std::size_t edge,
                        std::size_t layer, const StripCounts& strips, double beside_m) {
  const std::int32_t left_face = face_beside(complex, edge, true, beside_m);
  const std::int32_t right_face = face_beside(complex, edge, false, beside_m);
  double score = kStripWeight * (strips.left - strips.right) / (strips.left + strips.right + kStripPrior);
  const auto ask = [&](const std::vector<float>& kind, std::size_t level) {
    const auto on = [&](std::int32_t face) {
      return face < 0 ? 0.0 : kind[complex.level_face(static_cast<std::size_t>(face), level)];
    };
    const double left = on(left_face);
    const double right = on(right_face);
    score += left + right > kSeen ? kLevelWeight * (left - right) / (left + right + kPrior) : 0;
    return left + right > kSeen;
  };
  const auto goes_on = [&](std::size_t k) {
    return weights.wall_omega[complex.wall_face(edge, k)] > kContinues;
  };
  for (std::size_t l = layer; !ask(weights.level_floor, l) && l > 0 && goes_on(l - 1); --l) {
  }
  for (std::size_t l = layer + 1; !ask(weights.level_ceiling, l) && l < complex.layers() && goes_on(l); ++l) {
  }
  return 1 / (1 + std::exp(-score));
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/plan_walk.h"

#include <limits>

namespace roomcut {
namespace {

struct Exit {
  std::int32_t edge = -1;
  double distance = std::numeric_limits<double>::infinity();
};

/// Where the way from `start` to `to` leaves the face: by the side whose ends lie right and left of it. Of
/// sides on one line the distances are equal; their ends tell them apart.
Exit exit_of(const CellComplex& complex, std::size_t face, const Vec2& start, const Vec2& to) {
  const auto begin = static_cast<std::size_t>(complex.face_offset[face]);
  const auto end = static_cast<std::size_t>(complex.face_offset[face + 1]);
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t next = i + 1 < end ? i + 1 : begin;
    const Vec2 a = complex.vertices[static_cast<std::size_t>(complex.face_vertex[i])] - start;
    const Vec2 b = complex.vertices[static_cast<std::size_t>(complex.face_vertex[next])] - start;
    const double right = to.x() * a.y() - to.y() * a.x();
    const double left = to.x() * b.y() - to.y() * b.x();
    if (right <= 0 && left > 0) {
      return {complex.face_edge[i], (a + right / (right - left) * (b - a)).dot(to)};
    }
  }
  return {};
}

}  // namespace

std::int32_t walk_beside(const CellComplex& complex, std::size_t edge, bool left, double distance_m,
                         const std::function<void(std::size_t, bool)>& crossed) {
  const CellComplex::Edge& e = complex.edges[edge];
  const Vec2& a = complex.vertices[static_cast<std::size_t>(e.v0)];
  const Vec2 along = complex.vertices[static_cast<std::size_t>(e.v1)] - a;
  const Vec2 start = a + 0.5 * along;
  const Vec2 to = (left ? 1 : -1) * Vec2(-along.y(), along.x()).normalized();
  std::int32_t face = left ? e.left : e.right;
  // Every step crosses another edge; rounding at a sliver may not send the walk around for ever.
  for (std::size_t step = 0; face >= 0 && step < complex.edges.size(); ++step) {
    const Exit exit = exit_of(complex, static_cast<std::size_t>(face), start, to);
    if (exit.edge < 0 || exit.distance >= distance_m) {
      return face;
    }
    const auto other = static_cast<std::size_t>(exit.edge);
    const bool from_left = complex.edges[other].left == face;
    if (crossed) {
      crossed(other, from_left);
    }
    face = from_left ? complex.edges[other].right : complex.edges[other].left;
  }
  return face;
}

}  // namespace roomcut

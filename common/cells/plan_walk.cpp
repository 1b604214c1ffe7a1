// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/plan_walk.h"

namespace roomcut {

FaceExit leave_face(const CellComplex& complex, std::size_t face, const Vec2& start, const Vec2& to) {
  const FaceCorners corners = complex.corners(face);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i] - start;
    const Vec2 b = corners.after(i) - start;
    const double right = to.x() * a.y() - to.y() * a.x();
    const double left = to.x() * b.y() - to.y() * b.x();
    if (right <= 0 && left > 0) {
      return {complex.edges_of(face)[i], (a + right / (right - left) * (b - a)).dot(to)};
    }
  }
  return {};
}

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
    const FaceExit exit = leave_face(complex, static_cast<std::size_t>(face), start, to);
    if (exit.edge < 0 || exit.distance >= distance_m) {
      return face;
    }
    const auto other = static_cast<std::size_t>(exit.edge);
    if (crossed) {
      crossed(other, complex.edges[other].left == face);
    }
    face = complex.edges[other].across(face);
  }
  return face;
}

}  // namespace roomcut

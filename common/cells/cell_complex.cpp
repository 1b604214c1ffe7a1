// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/cell_complex.h"

namespace roomcut {

namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

double CellComplex::area(std::size_t face) const {
  // Relative to the first corner: no cancellation far from the origin, and slivers keep their sign.
  const std::int64_t begin = face_offset[face];
  const std::int64_t end = face_offset[face + 1];
  const Vec2 base = vertices[face_vertex[begin]];
  double twice = 0;
  for (std::int64_t i = begin + 1; i + 1 < end; ++i) {
    twice += cross(vertices[face_vertex[i]] - base, vertices[face_vertex[i + 1]] - base);
  }
  return 0.5 * twice;
}

Vec2 CellComplex::centroid(std::size_t face) const {
  const std::int64_t begin = face_offset[face];
  const std::int64_t end = face_offset[face + 1];
  const Vec2 base = vertices[face_vertex[begin]];
  double twice = 0;
  Vec2 moment(0, 0);
  Vec2 sum(0, 0);
  for (std::int64_t i = begin + 1; i < end; ++i) {
    const Vec2 p = vertices[face_vertex[i]] - base;
    sum += p;
    if (i + 1 < end) {
      const Vec2 q = vertices[face_vertex[i + 1]] - base;
      const double w = cross(p, q);
      twice += w;
      moment += w * (p + q);
    }
  }
  if (twice > 0) {
    return base + moment / (3 * twice);
  }
  return base + sum / static_cast<double>(end - begin);  // a sliver without area: the mean of its corners
}

void DataTerms::reset(const CellComplex& complex) {
  features.clear();
  for (std::vector<float>* values :
       {&kappa, &vertical, &around, &winding, &surface_m2, &thin, &line_of_sight, &observed, &beta}) {
    values->assign(complex.cells(), 0);
  }
  wall_implied.assign(complex.edges.size() * complex.layers(), 0);
  level_implied.assign(complex.faces() * complex.levels.size(), 0);
  d_empty.assign(complex.cells(), 0);
  d_solid.assign(complex.cells(), 0);
}

}  // namespace roomcut

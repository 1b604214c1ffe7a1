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
  const FaceCorners corner = corners(face);
  const Vec2 base = corner[0];
  double twice = 0;
  for (std::size_t i = 1; i + 1 < corner.size(); ++i) {
    twice += cross(corner[i] - base, corner[i + 1] - base);
  }
  return 0.5 * twice;
}

Vec2 CellComplex::centroid(std::size_t face) const {
  const FaceCorners corner = corners(face);
  const Vec2 base = corner[0];
  double twice = 0;
  Vec2 moment(0, 0);
  Vec2 sum(0, 0);
  for (std::size_t i = 1; i < corner.size(); ++i) {
    const Vec2 p = corner[i] - base;
    sum += p;
    if (i + 1 < corner.size()) {
      const Vec2 q = corner[i + 1] - base;
      const double w = cross(p, q);
      twice += w;
      moment += w * (p + q);
    }
  }
  if (twice > 0) {
    return base + moment / (3 * twice);
  }
  // A sliver without area: the mean of its corners.
  return base + sum / static_cast<double>(corner.size());
}

Vec3 CellComplex::centre(std::size_t cell) const {
  const Vec2 middle = centroid(face_of(cell));
  const std::size_t layer = layer_of(cell);
  return {middle.x(), middle.y(), levels[layer] + 0.5 * height(layer)};
}

std::int32_t CellComplex::layer_at(double z) const {
  const auto above = std::upper_bound(levels.begin(), levels.end(), z);
  return above == levels.end() ? -1 : static_cast<std::int32_t>(above - levels.begin()) - 1;
}

void DataTerms::reset(const CellComplex& complex) {
  features.clear();
  for (std::vector<float>* values : {&kappa, &vertical, &around, &winding, &surface_m2, &thin, &line_of_sight,
                                     &observed, &closed, &beta}) {
    values->assign(complex.cells(), 0);
  }
  wall_implied.assign(complex.edges.size() * complex.layers(), 0);
  level_implied.assign(complex.faces() * complex.levels.size(), 0);
  d_empty.assign(complex.cells(), 0);
  d_solid.assign(complex.cells(), 0);
}

}  // namespace roomcut

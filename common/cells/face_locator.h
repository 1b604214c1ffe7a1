// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/plan_grid.h"

namespace roomcut {

/// Tells which face of a complex's plan, and which cell, holds a point. Every point of the bounding box, its
/// sides included, has exactly one face, the same for every numbering of the corners: one on an edge has that
/// to its right (towards +x; on a level edge that above it), as far as rounding can tell. The complex must be
/// free of violations and outlive the locator; queries are const and thread-safe. A query looks at the few
/// faces whose box meets that of one bin of a grid, about as many bins as faces.
class FaceLocator {
 public:
  explicit FaceLocator(const CellComplex& complex);

  /// The face at p [m]; -1 beyond the bounding box.
  std::int32_t face_at(const Vec2& p) const;
  /// The cell at p [m], which begins at its lower level; -1 beyond the bounding box or all levels.
  std::int64_t cell_at(const Vec3& p) const;

 private:
  bool contains(std::size_t face, const Vec2& p) const;

  const CellComplex& complex_;
  Vec2 low_{0, 0}, high_{0, 0};
  PlanGrid grid_;
  std::vector<std::uint32_t> first_;  // bins + 1: the faces of bin b are faces_[first_[b] … first_[b + 1])
  std::vector<std::int32_t> faces_;   // per bin, ascending
};

}  // namespace roomcut

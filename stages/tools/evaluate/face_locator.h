// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::evaluate {

/// Tells which face of a complex's plan holds a point. The complex must outlive it; queries are const and
/// thread-safe. A point on an edge belongs to the first of its faces.
class FaceLocator {
 public:
  explicit FaceLocator(const CellComplex& complex);

  /// The face around (x, y); -1 beyond the bounding box.
  std::int32_t face_at(double x, double y) const;

 private:
  bool contains(std::int32_t face, const Vec2& p) const;
  std::size_t bucket(double x, double y) const;

  const CellComplex& complex_;
  Vec2 lo_{0, 0}, hi_{0, 0};
  double cell_ = 1;  // edge of a bucket [m]
  std::int64_t nx_ = 1, ny_ = 1;
  std::vector<std::vector<std::int32_t>> faces_in_;  // per bucket, ascending
};

/// Distance in the plan from p to the nearest edge of a face that lies on a wall line; infinite without one.
double distance_to_lines(const CellComplex& complex, std::int32_t face, const Vec2& p);

}  // namespace roomcut::evaluate

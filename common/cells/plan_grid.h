// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/cells/cell_complex.h"

namespace roomcut {

/// A square grid over the plan of the complex. Its cells begin at the local origin, not at the complex's
/// corner, which lies where the last point or line ends by chance.
struct PlanGrid {
  Vec2 low{0, 0};
  double cell = 1;
  int nx = 0, ny = 0;

  PlanGrid(const CellComplex& complex, double cell_edge) : cell(cell_edge) {
    Vec2 high = low;
    if (!complex.vertices.empty()) {
      low = high = complex.vertices.front();
    }
    for (const Vec2& v : complex.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    low = cell * (low / cell).array().floor().matrix();
    nx = std::max(1, static_cast<int>(std::ceil((high.x() - low.x()) / cell)));
    ny = std::max(1, static_cast<int>(std::ceil((high.y() - low.y()) / cell)));
  }
  std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  int column(double x) const { return whole((x - low.x()) / cell); }
  int row(double y) const { return whole((y - low.y()) / cell); }
  bool contains(int ix, int iy) const { return ix >= 0 && iy >= 0 && ix < nx && iy < ny; }
  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(ix);
  }

 private:
  /// floor(), without the library call that it is on plain x86-64.
  static int whole(double value) {
    const int truncated = static_cast<int>(value);
    return truncated - (value < truncated ? 1 : 0);
  }
};

}  // namespace roomcut

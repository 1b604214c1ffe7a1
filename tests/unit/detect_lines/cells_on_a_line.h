// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/random/counter_random.h"
#include "stages/detect_lines/line_fit.h"

namespace roomcut::testing {
using namespace roomcut::detect_lines;

/// Adds cells of 4 cm on `line` from t0 to t1, off it by up to `scatter_m` to both sides.
inline void add_cells(WallCells& cells, const Line2& line, double t0, double t1, double scatter_m = 0,
                      int slice = 0) {
  const auto n = static_cast<std::uint64_t>((t1 - t0) / 0.04);
  for (std::uint64_t i = 0; i < n; ++i) {
    const double off = scatter_m * (2 * random_unit(3, cells.size(), i) - 1);
    const Vec2 p = line.at(t0 + 0.04 * (static_cast<double>(i) + 0.5)) + off * line.normal();
    cells.x.push_back(static_cast<float>(p.x()));
    cells.y.push_back(static_cast<float>(p.y()));
    cells.weight_m.push_back(0.04F);
    cells.area_m2.push_back(0.02F);
    cells.coverage.push_back(1);
    cells.theta.push_back(static_cast<float>(line.theta));
    cells.offset_m.push_back(0);
    cells.boundary.push_back(1);
    cells.slice.push_back(slice);
    cells.line.push_back(-1);
  }
}

inline CellIndices all_of(const WallCells& cells) {
  CellIndices all(cells.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

inline const FitRules kRules{0.02, 0.3, 0.01, 0.08, 3.0};

}  // namespace roomcut::testing

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "stages/slice/surfaces.h"

namespace roomcut {

/// Disjoint sets with the smallest member as root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Finds cells by their place. Cells must be sorted by (iy, ix, z) and outlive the index.
class CellIndex {
 public:
  explicit CellIndex(const std::vector<SurfaceCell>& cells) : cells_(cells) {
    if (cells.empty()) return;
    iy0_ = cells.front().iy;
    first_.assign(static_cast<std::size_t>(cells.back().iy - iy0_) + 2, cells.size());
    for (std::size_t i = cells.size(); i-- > 0;) first_[static_cast<std::size_t>(cells[i].iy - iy0_)] = i;
    for (std::size_t r = first_.size() - 1; r-- > 0;) first_[r] = std::min(first_[r], first_[r + 1]);
  }

  /// The cells [first, second) of row iy with ix0 <= ix <= ix1.
  std::pair<std::size_t, std::size_t> find(std::int32_t iy, std::int32_t ix0, std::int32_t ix1) const {
    if (first_.empty() || iy < iy0_ || iy >= iy0_ + static_cast<std::int32_t>(first_.size()) - 1)
      return {0, 0};
    const auto row = static_cast<std::size_t>(iy - iy0_);
    const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(first_[row]);
    const auto end = cells_.begin() + static_cast<std::ptrdiff_t>(first_[row + 1]);
    const auto from =
        std::lower_bound(begin, end, ix0, [](const SurfaceCell& c, std::int32_t ix) { return c.ix < ix; });
    const auto to =
        std::upper_bound(from, end, ix1, [](std::int32_t ix, const SurfaceCell& c) { return ix < c.ix; });
    return {static_cast<std::size_t>(from - cells_.begin()), static_cast<std::size_t>(to - cells_.begin())};
  }

  /// Whether a cell with lo <= z <= hi lies within `radius` columns of (ix, iy).
  bool any_near(std::int32_t ix, std::int32_t iy, std::int32_t radius, double lo, double hi) const {
    for (std::int32_t dy = -radius; dy <= radius; ++dy) {
      const auto [from, to] = find(iy + dy, ix - radius, ix + radius);
      for (std::size_t j = from; j < to; ++j) {
        if (lo <= cells_[j].z && cells_[j].z <= hi) return true;
      }
    }
    return false;
  }

 private:
  const std::vector<SurfaceCell>& cells_;
  std::int32_t iy0_ = 0;
  std::vector<std::size_t> first_;
};

/// How many columns a cell reaches: 1, or 2.5 spacings of its points where they are sparse, at most 5.
inline std::int32_t reach_of(const SurfaceCell& cell, double raster_m) {
  const double spacing = std::sqrt(cell.area_m2 / std::max(1, cell.count));
  return std::clamp(static_cast<std::int32_t>(std::ceil(2.5 * spacing / raster_m)), 1, 5);
}

/// Joins all pairs of cells in different columns that reach each other and for which `connected(a, b)` holds.
template <class Connected>
DisjointSets connect_cells(const std::vector<SurfaceCell>& cells, double raster_m, Connected connected) {
  DisjointSets sets(cells.size());
  const CellIndex index(cells);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const SurfaceCell& cell = cells[i];
    const std::int32_t reach = reach_of(cell, raster_m);
    for (std::int32_t dy = 0; dy <= reach;
         ++dy) {  // the other half of the neighbours meets this cell from there
      const auto [from, to] =
          index.find(cell.iy - dy, cell.ix - reach, dy == 0 ? cell.ix - 1 : cell.ix + reach);
      for (std::size_t j = from; j < to; ++j) {
        const std::int32_t near = std::min(reach, reach_of(cells[j], raster_m));
        const std::int32_t dx = cell.ix - cells[j].ix;
        if (dx * dx + dy * dy <= near * near && connected(cells[j], cell)) sets.join(i, j);
      }
    }
  }
  return sets;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "stages/slice/surfaces.h"

namespace roomcut::slice {

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
  /// Joins the sets of two different roots; returns the root of both.
  std::size_t join_roots(std::size_t a, std::size_t b) {
    parent_[std::max(a, b)] = std::min(a, b);
    return std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Finds cells by their place: one entry per column of their box. Cells must be sorted by (iy, ix, z) and
/// outlive it.
class CellIndex {
 public:
  explicit CellIndex(const std::vector<SurfaceCell>& cells) : cells_(cells) {
    if (cells.empty()) return;
    iy0_ = cells.front().iy;
    ny_ = cells.back().iy - iy0_ + 1;
    std::int32_t ix1 = ix0_ = cells.front().ix;
    for (const SurfaceCell& cell : cells) {
      ix0_ = std::min(ix0_, cell.ix);
      ix1 = std::max(ix1, cell.ix);
    }
    nx_ = ix1 - ix0_ + 1;
    const auto columns = static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_);
    first_.resize(columns + 1);
    std::size_t column = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t own = index(cells[i].ix - ix0_, cells[i].iy - iy0_);
      while (column <= own) first_[column++] = static_cast<std::uint32_t>(i);
    }
    while (column <= columns) first_[column++] = static_cast<std::uint32_t>(cells.size());
  }

  /// The cells [first, second) of row iy with ix0 <= ix <= ix1.
  std::pair<std::size_t, std::size_t> find(std::int32_t iy, std::int32_t ix0, std::int32_t ix1) const {
    const std::int32_t from = std::max(ix0 - ix0_, 0);
    const std::int32_t to = std::min(ix1 - ix0_, nx_ - 1);
    if (iy < iy0_ || iy >= iy0_ + ny_ || from > to) return {0, 0};
    return {first_[index(from, iy - iy0_)], first_[index(to, iy - iy0_) + 1]};
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
  std::size_t index(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x);
  }

  const std::vector<SurfaceCell>& cells_;
  std::int32_t ix0_ = 0, iy0_ = 0, nx_ = 0, ny_ = 0;
  std::vector<std::uint32_t> first_;
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
  std::vector<std::int32_t> reach(cells.size());
  std::transform(cells.begin(), cells.end(), reach.begin(),
                 [&](const SurfaceCell& c) { return reach_of(c, raster_m); });
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const SurfaceCell& cell = cells[i];
    std::size_t root = sets.root(i);
    for (std::int32_t dy = 0; dy <= reach[i];
         ++dy) {  // the other half of the neighbours meets this cell from there
      const auto [from, to] =
          index.find(cell.iy - dy, cell.ix - reach[i], dy == 0 ? cell.ix - 1 : cell.ix + reach[i]);
      for (std::size_t j = from; j < to; ++j) {
        const std::int32_t near = std::min(reach[i], reach[j]);
        const std::int32_t dx = cell.ix - cells[j].ix;
        if (dx * dx + dy * dy > near * near) continue;
        const std::size_t other = sets.root(j);
        if (other != root && connected(cells[j], cell)) root = sets.join_roots(root, other);
      }
    }
  }
  return sets;
}

}  // namespace roomcut::slice

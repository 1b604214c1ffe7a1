// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "stages/slice/fixed_point.h"
#include "stages/slice/surfaces.h"

namespace roomcut::slice {

/// A set of plan cells of kUprightPlan, as a bitmap over their box.
class PlanMask {
 public:
  /// Room for the plan cells of `cells` and their neighbours, none set.
  PlanMask(const std::vector<SurfaceCell>& cells, double raster_m) : raster_m_(raster_m) {
    if (cells.empty()) return;
    const auto by_ix = [](const SurfaceCell& a, const SurfaceCell& b) { return a.ix < b.ix; };
    const auto [west, east] = std::minmax_element(cells.begin(), cells.end(), by_ix);
    ix0_ = plan_cell(west->ix) - 1;
    iy0_ = plan_cell(cells.front().iy) - 1;
    nx_ = plan_cell(east->ix) + 2 - ix0_;
    ny_ = plan_cell(cells.back().iy) + 2 - iy0_;
    bits_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), 0);
  }

  /// Sets the plan cell in which `cell` lies, and its 8 neighbours.
  void add(const SurfaceCell& cell) {
    const std::int32_t x = plan_cell(cell.ix) - ix0_;
    const std::int32_t y = plan_cell(cell.iy) - iy0_;
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
      for (std::int32_t dx = -1; dx <= 1; ++dx) bits_[index(x + dx, y + dy)] = 1;
    }
  }

  bool contains(const UprightBlock& block) const {
    const std::int32_t x = block.ix - ix0_;
    const std::int32_t y = block.iy - iy0_;
    return x >= 0 && x < nx_ && y >= 0 && y < ny_ && bits_[index(x, y)] != 0;
  }

 private:
  std::int32_t plan_cell(std::int32_t i) const { return floor_to_int((i + 0.5) * raster_m_ / kUprightPlan); }
  std::size_t index(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x);
  }

  double raster_m_;
  std::int32_t ix0_ = 0, iy0_ = 0, nx_ = 0, ny_ = 0;
  std::vector<std::uint8_t> bits_;
};

}  // namespace roomcut::slice

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace roomcut::weigh_faces {

/// Sums over rectangles of a grid in O(1). Values are given row by row.
class AreaTable {
 public:
  AreaTable() = default;
  template <class Values>
  AreaTable(const Values& values, int nx, int ny) : nx_(nx), ny_(ny) {
    sums_.assign(static_cast<std::size_t>(nx + 1) * static_cast<std::size_t>(ny + 1), 0.0);
    for (int y = 0; y < ny; ++y) {
      double row = 0;
      for (int x = 0; x < nx; ++x) {
        row += static_cast<double>(
            values[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x)]);
        sums_[at(x + 1, y + 1)] = sums_[at(x + 1, y)] + row;
      }
    }
  }
  /// Sum over the bins [x0, x1) × [y0, y1), clipped to the grid.
  double bins(int x0, int x1, int y0, int y1) const {
    if (x0 < 0 || y0 < 0 || x1 > nx_ || y1 > ny_ || x0 > x1 || y0 > y1) {
      x0 = std::clamp(x0, 0, nx_);
      x1 = std::clamp(x1, x0, nx_);
      y0 = std::clamp(y0, 0, ny_);
      y1 = std::clamp(y1, y0, ny_);
    }
    return sums_[at(x1, y1)] - sums_[at(x0, y1)] - sums_[at(x1, y0)] + sums_[at(x0, y0)];
  }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_ + 1) + static_cast<std::size_t>(x);
  }

  int nx_ = 0, ny_ = 0;
  std::vector<double> sums_;  // running down the columns and along the rows
};

/// 1 / P(a bin of `area` on a covered surface holds a point), given the point density around it; at most 25.
/// Occupied bins weighted so (Horvitz-Thompson) sum up to the covered area whatever the density.
double occupancy_weight(double density, double area);

/// Points per square metre of the same surface around bin (x, y): the smallest window of at most 11 × 11 bins
/// that holds 10 points. `counts` are points, `areas` the surface in each bin [m²].
double window_density(const AreaTable& counts, const AreaTable& areas, int x, int y);

/// The density around every occupied bin (0 in the others), of the covered part of the surface only: first of
/// the whole window, then again with the area that the first pass calls covered, so that the rim of a covered
/// part is not taken for a thin one. `area_table`: of `areas`.
std::vector<float> local_density(const std::vector<float>& points, const std::vector<float>& areas,
                                 const AreaTable& area_table, int nx, int ny);

}  // namespace roomcut::weigh_faces

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::extract {

struct StoreyParams {
  double least_gap_m = 1.8;     ///< between the floors of two storeys
  double least_floor_m2 = 4.0;  ///< of a storey
};

/// The storeys of a labelled complex. A run (the empty cells above each other over one plan face, without a
/// gap) belongs as a whole to the storey of its floor: a hall that is open through two storeys counts for the
/// lower one.
struct Storeys {
  std::vector<double> floor_z;        ///< height of each storey's largest floor level, ascending [m]
  std::vector<std::int16_t> of_cell;  ///< storey of every empty cell; -1 = solid
};

/// Floor levels become storeys in order of their area unless a larger one is within least_gap_m; storeys
/// whose floors add up to less than least_floor_m2 (or 5 % of the largest one's) are given up. A run belongs
/// to the highest storey whose floor is not more than half a gap above the run's bottom and below its top,
/// else to the lowest.
Storeys find_storeys(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                     const StoreyParams& params);

/// The storey of a run between two heights, of storeys whose floors are given, ascending [m].
std::int16_t storey_of_run(const std::vector<double>& floor_z, double bottom, double top, double gap_m);

/// Calls f(face, first layer, one past the last layer) for every stack of cells of one piece without a gap,
/// by plan face and height; `piece` per cell, -1 = none.
template <class F>
void for_each_stack(const CellComplex& complex, const std::vector<std::int32_t>& piece, F&& f) {
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    for (std::size_t k = 0; k < complex.layers();) {
      const std::size_t first = k;
      const std::int32_t of = piece[complex.cell(face, k)];
      while (k < complex.layers() && piece[complex.cell(face, k)] == of) {
        ++k;
      }
      if (of >= 0) {
        f(face, first, k);
      }
    }
  }
}

/// Calls f(face, first layer, one past the last layer) for every run, by plan face and height.
template <class F>
void for_each_run(const CellComplex& complex, const std::vector<std::uint8_t>& label, F&& f) {
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    for (std::size_t k = 0; k < complex.layers();) {
      const std::size_t first = k;
      while (k < complex.layers() && is_empty(label, complex.cell(face, k))) {
        ++k;
      }
      if (k > first) {
        f(face, first, k);
      } else {
        ++k;
      }
    }
  }
}

}  // namespace roomcut::extract

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stages/detect_lines/line_fit.h"

namespace roomcut::detect_lines {

/// The pieces of wall that no line has taken yet, in squares: those on a line are found along it, at a cost
/// that grows with the building's diagonal and not with its area. Otherwise the search would take the square
/// of the building.
class FreeCells {
 public:
  /// All boundary cells of `cells`, which must outlive this.
  explicit FreeCells(const WallCells& cells);

  /// The free cells on `line`, as inliers() of all of them would give, in ascending order.
  CellIndices on_line(const Line2& line, const FitRules& rules, double distance_m) const;

  /// From now on `taken` are not free.
  void take(const CellIndices& taken);

 private:
  std::size_t square_of(std::uint32_t cell) const;
  template <class Visit>
  void for_squares(const Line2& line, double reach_m, Visit&& visit) const;

  const WallCells& cells_;
  double edge_ = 1;                          ///< of a square [m]
  std::array<double, 2> low_{};              ///< corner of the first square [m]
  std::array<std::ptrdiff_t, 2> squares_{};  ///< in x and y
  std::vector<std::uint32_t> begin_, end_;   ///< per square, row-major: its free cells in `sorted_`
  CellIndices sorted_;
  std::vector<std::uint8_t> taken_;  ///< per cell
};

}  // namespace roomcut::detect_lines

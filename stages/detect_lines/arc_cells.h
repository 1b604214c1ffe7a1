// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "stages/detect_lines/circle_fit.h"

namespace roomcut::detect_lines {

/// A stretch of a circle by the arc length from the bend's point, counter-clockwise seen from the centre [m].
struct Stretch {
  double low = 0, high = 0;
  double length() const { return high - low; }
};

/// Where p lies along the bend's circle, from the bend's point on: -pi r ... pi r [m].
double along(const Bend& bend, const Vec2& p);

/// The cells of all slices in squares, to find those near a place or along a circle.
class CellSquares {
 public:
  /// `cells` must outlive this; squares of `edge_m`.
  CellSquares(const WallCells& cells, double edge_m);

  /// The cells of the 3 x 3 squares around p.
  template <class Visit>
  void near(const Vec2& p, Visit&& visit) const {
    const auto [ix, iy] = square_of(p);
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      for (std::int64_t dx = -1; dx <= 1; ++dx) {
        const std::int64_t key = key_of(ix + dx, iy + dy);
        for (auto it = first_of(key); it != sorted_.end() && it->first == key; ++it) visit(it->second);
      }
    }
  }

  /// The cells within `reach_m` (below the squares' edge) of a stretch of the bend's circle, ascending.
  CellIndices along_circle(const Bend& bend, const Stretch& stretch, double reach_m) const;

  /// The cells that a chain of neighbours joins to `seed`, each turned but little against the one before and
  /// in one row with it, within `reach_m` of the seed, ascending. Cells without a direction belong to none.
  CellIndices chain(std::uint32_t seed, double reach_m) const;

 private:
  std::pair<std::int64_t, std::int64_t> square_of(const Vec2& p) const;
  static std::int64_t key_of(std::int64_t ix, std::int64_t iy) { return iy * (std::int64_t{1} << 32) + ix; }
  std::vector<std::pair<std::int64_t, std::uint32_t>>::const_iterator first_of(std::int64_t key) const;

  const WallCells& cells_;
  double edge_;
  std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;  ///< square, cell
};

}  // namespace roomcut::detect_lines

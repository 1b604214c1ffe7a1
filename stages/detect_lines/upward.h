// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "common/geometry/line2.h"
#include "stages/detect_lines/wall_cells.h"

namespace roomcut::detect_lines {

/// Tells what goes up to the ceiling from furniture, across slices. Keeps a reference to the cells.
class Upward {
 public:
  Upward(const WallCells& cells, double tau_m);

  /// Whether a wall seen on `line` from t0 to t1 in a slice is seen in the slices above it, too, on two
  /// fifths of its length, up to the first one in which nothing stands around: the slab. Where other walls go
  /// on and this does not, it was furniture.
  bool reaches_ceiling(const Line2& line, double t0, double t1, std::int32_t slice) const;

 private:
  struct Seen {
    double share;  ///< of the length
    bool around;   ///< anything stands beside it
  };
  Seen look(const Line2& line, double t0, double t1, std::int32_t slice) const;
  using Key = std::pair<std::int32_t, std::pair<std::int32_t, std::int32_t>>;  // slice, row and column
  Key key_of(std::int32_t slice, double x, double y) const;

  const WallCells& cells_;
  double tau_m_;
  std::int32_t slices_ = 0;
  std::vector<std::pair<Key, std::uint32_t>> by_place_;  // sorted
};

}  // namespace roomcut::detect_lines

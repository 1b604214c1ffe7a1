// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "common/cloud/cloud.h"

namespace roomcut::ingest {

/// How floors and ceilings lean, from the heights of their points over their whole length: to a thousandth of
/// a degree, where normals (LeanSums), which know some decimetres each, are good to a hundredth. That is 0.2
/// mm on 10 m: a scan that came tilted has the model of the same scan that came level.
class FloorFit {
 public:
  using Slope = std::array<double, 2>;

  /// Sums the horizontal points of a part by squares of 0.8 m and 0.4 m of height. Whole numbers: the order
  /// does not matter.
  void add(const CloudTile& part);

  /// The slope of up, x and y, near `slope`, which LeanSums::floors() gives: least squares with an offset of
  /// its own for every surface whose squares follow each other by `slope` within a centimetre, robust
  /// (Cauchy). `slope` itself where less than 4 m^2 or a strip is left, or when the result is 0.1° or
  /// more from it. Deterministic.
  Slope slope(const Slope& slope) const;

 private:
  struct Place {
    std::int32_t iy, ix, iz;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  struct Sums {
    std::int64_t points = 0;
    std::int64_t x = 0, y = 0, z = 0;  ///< from the cell's corner, 2^-14 m
    std::int64_t area = 0;             ///< 2^-30 m^2
  };
  struct Square;
  std::vector<Square> squares() const;
  static void join(std::vector<Square>& all, const Slope& slope);
  static bool solve(const std::vector<Square>& all, std::vector<double>& residual, Slope& slope);

  std::map<Place, Sums> cells_;
};

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace roomcut {

/// How stairs stand for sloped planes: which level a height of a plane belongs to. Between two neighbouring
/// real levels that is the nearest of the steps there or, where there are none, the lower of the two.
class Stairs {
 public:
  /// `step`: per level, whether it stands for sloped planes alone (CellComplex::steps). Both must outlive it.
  Stairs(const std::vector<double>& levels, const std::vector<std::uint8_t>& step)
      : levels_(levels), step_(step) {}

  std::size_t level_of(double z) const {
    const auto above =
        static_cast<std::size_t>(std::lower_bound(levels_.begin(), levels_.end(), z) - levels_.begin());
    if (above == 0) return 0;
    if (above == levels_.size()) return above - 1;
    const std::size_t below = above - 1;
    if (!has_riser(below)) return is_step(above) ? above : below;
    return z <= riser(below) ? below : above;
  }

  /// Whether both levels of the layer are steps; level_of() then passes from one to the other at riser().
  bool has_riser(std::size_t layer) const { return is_step(layer) && is_step(layer + 1); }
  double riser(std::size_t layer) const { return 0.5 * (levels_[layer] + levels_[layer + 1]); }
  bool is_step(std::size_t level) const { return level < step_.size() && step_[level] != 0; }

 private:
  const std::vector<double>& levels_;
  const std::vector<std::uint8_t>& step_;
};

}  // namespace roomcut

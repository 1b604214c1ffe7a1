// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace roomcut {

/// Where heights lie among ascending levels, by table: a search among ten levels is as much work as
/// everything else that is done with a point on a floor.
class LevelFinder {
 public:
  explicit LevelFinder(const std::vector<double>& levels) : levels_(levels) {
    if (levels_.empty()) {
      return;
    }
    const double height = std::max(levels_.back() - levels_.front(), 1e-6);
    per_step_ = kSteps / height;
    for (std::size_t step = 0; step < kSteps; ++step) {
      // One step early: rounding may put a height into the next one.
      const double z = levels_.front() + (static_cast<double>(step) - 1) / per_step_;
      first_[step] = first_from(z);
    }
  }

  /// Index of the first level that is not below z, or their number: std::lower_bound.
  std::size_t first_not_below(double z) const {
    if (levels_.empty() || !(z > levels_.front())) {
      return 0;
    }
    const double step = (z - levels_.front()) * per_step_;
    std::size_t level = first_[step < kSteps ? static_cast<std::size_t>(step) : kSteps - 1];
    while (level < levels_.size() && levels_[level] < z) {
      ++level;
    }
    return level;
  }

 private:
  static constexpr std::size_t kSteps = 1024;
  std::size_t first_from(double z) const {
    return static_cast<std::size_t>(std::lower_bound(levels_.begin(), levels_.end(), z) - levels_.begin());
  }

  std::vector<double> levels_;
  double per_step_ = 1;
  std::vector<std::size_t> first_ = std::vector<std::size_t>(kSteps, 0);
};

}  // namespace roomcut

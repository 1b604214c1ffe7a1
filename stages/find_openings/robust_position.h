// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

namespace roomcut::find_openings {

/// Count and mean position of the points in one bin of a profile, in one 64-bit sum: additions commute, so
/// the result does not depend on the order of the points.
struct BinSum {
  static constexpr int kSumBits = 40;
  static constexpr double kSteps = 1024;  ///< of position inside a bin

  /// What one point adds; `position` inside the bin, 0 … 1.
  static std::uint64_t pack(double position) {
    return (std::uint64_t{1} << kSumBits) + static_cast<std::uint64_t>(position * kSteps);
  }
  static std::uint32_t count(std::uint64_t sum) { return static_cast<std::uint32_t>(sum >> kSumBits); }
  /// Mean position inside the bin, 0 … 1; the bin must not be empty.
  static double mean(std::uint64_t sum) {
    return (static_cast<double>(sum & ((std::uint64_t{1} << kSumBits) - 1)) / count(sum) + 0.5) / kSteps;
  }
};

struct RobustPosition {
  double at = 0;             ///< in bins from the start of the profile
  double sigma = 0;          ///< standard deviation of `at` [bins]
  std::uint32_t points = 0;  ///< that carry weight
};

/// Location of the points of `profile` near the bin `start`: from the mean of the bins within `window` of it,
/// Tukey's biweight with cut-off `reach` [bins], iterated to rest. What lies evenly on one side of the
/// surface (points of the wall's faces that noise has put inside the wall) is taken off first: per side, the
/// mean count of the bins from `reach` to 15 bins further. `noise` [bins] is the standard deviation expected
/// of one point.
RobustPosition robust_position(std::span<const std::uint64_t> profile, std::size_t start, std::size_t window,
                               double reach, double noise);

}  // namespace roomcut::find_openings

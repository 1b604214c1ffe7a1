// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace roomcut {

/// Bins of a histogram of offsets from a line or a plane. Each packs a count (upper 24 bits) and a
/// fixed-point sum of positions inside the bin (lower 40): one order-free addition per point, and means
/// without the bias of bin centres.
struct OffsetHistogram {
  static constexpr int kSumBits = 40;
  static constexpr std::uint64_t kSteps = 1024;  ///< of position inside a bin

  /// What one point adds; 0 … 1.
  static std::uint64_t pack(double position_in_bin) {
    constexpr double kHalf = 0.5;  // rounds what is never negative
    const auto step =
        static_cast<std::uint64_t>(std::clamp(position_in_bin, 0.0, 1.0) * (kSteps - 1) + kHalf);
    return (std::uint64_t{1} << kSumBits) + step;
  }
  static std::uint32_t count(std::uint64_t packed) { return static_cast<std::uint32_t>(packed >> kSumBits); }
  /// Mean position inside the bin, 0 … 1.
  static double mean(std::uint64_t packed);
};

/// A location, its uncertainty and the number of points behind it.
struct RobustOffset {
  double offset_m = 0, variance_m2 = 0, scatter_m2 = 0;
  std::uint32_t points = 0;  ///< 0: no location
};

/// Robust location of the offsets in `histogram` (bins of equal width over -half … +half [m]): the fullest
/// window of ± 2 noise, then Tukey's biweight with c = 3.5 noise to convergence. Unbiased for symmetric
/// noise; what is further off than c (skirtings, frames, furniture) doesn't count at all.
RobustOffset robust_offset(std::span<const std::uint64_t> histogram, double half_m, double noise_m);

}  // namespace roomcut

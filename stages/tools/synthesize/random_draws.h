// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "common/random/counter_random.h"

namespace roomcut::synthesize {

/// The random numbers of one point: a pure function of seed, stream and the point's number.
class PointDraws {
 public:
  PointDraws(std::uint64_t seed, std::uint64_t stream, std::uint64_t point)
      : state_(mix64(mix64(seed) ^ stream) ^ mix64(point)) {}
  double unit() {
    return static_cast<double>(mix64(state_ + 0x9e3779b97f4a7c15ULL * ++count_) >> 11) * 0x1.0p-53;
  }
  /// Two independent standard normal numbers (Box and Muller).
  std::pair<double, double> normals() {
    const double radius = std::sqrt(-2 * std::log(1 - unit()));
    const double angle = 2 * std::numbers::pi * unit();
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

 private:
  std::uint64_t state_;
  std::uint64_t count_ = 0;
};

}  // namespace roomcut::synthesize

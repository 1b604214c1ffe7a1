// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace roomcut::slice {

/// floor() for |x| < 2^31, several times faster than the library call of plain x86-64.
inline std::int32_t floor_to_int(double x) {
  const auto truncated = static_cast<std::int32_t>(x);
  return truncated - (x < static_cast<double>(truncated) ? 1 : 0);
}

/// Nearest whole number of a value >= 0: sums of these do not depend on their order.
inline std::int64_t to_units(double value, double unit) {
  constexpr double kHalf = 0.5;  // std::lround is a library call
  return static_cast<std::int64_t>(value * (1 / unit) + kHalf);
}

}  // namespace roomcut::slice

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace roomcut {

/// The edges of grids that follow from a measured density, noise or extent are preferred numbers (Renard's
/// R20: twenty per decade, 12 % apart). Else a rounding of the coordinates, which changes what was measured
/// in the fifth digit, would move the cells at the far end of a building by centimetres against it. `value` >
/// 0; the nearest one.
inline double preferred_number(double value) {
  constexpr double kPerDecade = 20;
  return std::pow(10.0, std::round(kPerDecade * std::log10(value)) / kPerDecade);
}

/// The smallest one that is not less than `value` > 0.
inline double preferred_number_above(double value) {
  constexpr double kPerDecade = 20;
  constexpr double kRounding = 1e-9;
  return std::pow(10.0, std::ceil(kPerDecade * std::log10(value) - kRounding) / kPerDecade);
}

}  // namespace roomcut

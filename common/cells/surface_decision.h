// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

namespace roomcut {

/// Which side of a face is empty.
enum class FaceSide : std::int8_t { kRight = -1, kUnclear = 0, kLeft = 1 };

// "Is this face a wall (a floor, a ceiling)?" has one answer, given here. weigh_faces asks on its way; others
// read it from the finished FaceWeights.

/// Probability that a face is a surface of which the share `omega` is covered: windows, furniture and shadows
/// hide parts of most walls and floors, so the rest of a face is like what was seen of it. A straight line
/// from 5 % (stray points, rims of other walls) to 40 %.
inline double surface_probability(double omega) {
  constexpr double kStray = 0.05, kWhole = 0.4;
  return std::clamp((omega - kStray) / (kWhole - kStray), 0.0, 1.0);
}

/// Rather a surface than none.
inline bool is_likely(double probability) {
  return probability >= 0.5;
}

/// Enough to overrule a cut that put no surface there.
inline bool is_sure(double probability) {
  return probability >= 1;
}

/// The empty side of a face, where three quarters of what covers it agree.
inline FaceSide clear_side(double omega, double left, double right) {
  constexpr double kAgree = 0.75;
  if (left > kAgree * omega) {
    return FaceSide::kLeft;
  }
  return right > kAgree * omega ? FaceSide::kRight : FaceSide::kUnclear;
}

}  // namespace roomcut

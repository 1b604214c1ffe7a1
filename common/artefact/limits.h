// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

/// How large what a file holds may be: the one place for it. A number beyond is damage, and is refused before
/// anything is computed, allocated or indexed with it. All are far beyond what `ingest` makes.
namespace roomcut::limits {

inline constexpr double kFarthest_m = 1e6;       ///< coordinates in the local frame, heights, lengths
inline constexpr double kLargestExtent_m = 5e3;  ///< of a scan's box along any axis; `ingest` takes 2 km
inline constexpr double kLargestArea_m2 = 1e10;
inline constexpr double kDensest = 1e12;         ///< points per square metre
inline constexpr double kSmallestEdge_m = 1e-3;  ///< of voxels, tiles, cells and bins that indices count
inline constexpr double kLargestEdge_m = 1e3;
inline constexpr double kLargestNoise_m = 10;      ///< it comes from voxels of at most 1.6 m
inline constexpr double kFarthestOrigin_m = 1e12;  ///< of the local frame in the scan's coordinates

/// Whether the number can be a coordinate or a length in the local frame; NaN and infinity cannot.
inline bool is_local(double metres) {
  return std::abs(metres) <= kFarthest_m;
}

/// Whether it is a unit vector that points up.
inline bool is_up(const double (&v)[3]) {
  return std::abs(std::hypot(v[0], v[1], v[2]) - 1) <= 1e-9 && v[2] > 0;
}

}  // namespace roomcut::limits

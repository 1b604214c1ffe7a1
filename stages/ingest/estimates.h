// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace roomcut {

/// Counts of a positive quantity in bins of 2 % (logarithmic), for a median that does not depend on order and
/// needs no memory per value. Range 1e-7 … 1e5; what lies outside falls into the end bins.
class LogHistogram {
 public:
  void add(double value, std::uint64_t weight = 1);
  void add(const LogHistogram& other);
  std::uint64_t total() const { return total_; }
  /// The median, within a bin's width; 0 when nothing was added.
  double median() const;

 private:
  static constexpr int kPerOctave = 35;
  static constexpr int kLowest = -24 * kPerOctave;
  static constexpr int kHighest = 17 * kPerOctave;
  std::array<std::uint64_t, kHighest - kLowest> bins_{};
  std::uint64_t total_ = 0;
};

/// What the voxels of a tile say of the whole cloud.
struct SurfaceEstimates {
  LogHistogram noise;  ///< standard deviation off the plane, one value per well-filled planar voxel [m]
  LogHistogram area;   ///< area per point, one value per point [m^2]
  void add(const SurfaceEstimates& other) {
    noise.add(other.noise);
    area.add(other.area);
  }
};

}  // namespace roomcut

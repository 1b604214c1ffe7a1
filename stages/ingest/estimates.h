// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "stages/ingest/lean.h"

namespace roomcut::ingest {

/// Counts of a positive quantity in bins of 1 to 1.6 % (64 equal parts of each octave, straight from the bits
/// of a float), for a median that does not depend on order and needs no memory per value. Values outside
/// 2^-24 … 2^17 fall into the end bins.
class LogHistogram {
 public:
  void add(float value, std::uint64_t weight = 1) {
    constexpr float kSmallest = 0x1p-24F;
    constexpr float kLargest = 0x1.fffffep16F;
    const float inside = value > kSmallest ? (value < kLargest ? value : kLargest) : kSmallest;
    bins_[(std::bit_cast<std::uint32_t>(inside) >> kDroppedBits) - kFirstBin] += weight;
    total_ += weight;
  }
  void add(const LogHistogram& other);
  std::uint64_t total() const { return total_; }
  /// The median, interpolated inside its bin; 0 when nothing was added.
  double median() const;
  /// The counts in the bins below the limit, alone.
  LogHistogram below(double limit) const;

 private:
  static double edge(std::size_t bin);

  static constexpr int kDroppedBits = 23 - 6;
  static constexpr std::uint32_t kFirstBin = (127 - 24) << 6;
  std::array<std::uint64_t, (24 + 17) << 6> bins_{};
  std::uint64_t total_ = 0;
};

/// What the voxels of a tile say of the whole cloud.
struct SurfaceEstimates {
  LogHistogram noise;  ///< standard deviation off the plane, one value per well-filled planar voxel [m]
  LogHistogram area;   ///< area per point, one value per point [m^2]
  LeanSums lean;       ///< one value per coarse voxel with a flat neighbourhood
  void add(const SurfaceEstimates& other) {
    noise.add(other.noise);
    area.add(other.area);
    lean.add(other.lean);
  }
};

}  // namespace roomcut::ingest

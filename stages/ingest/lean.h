// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "stages/ingest/floor_fit.h"

namespace roomcut::ingest {

/// How a plane leans, in units of 2^-15: of a level one the slope of its normal along x and y; of an upright
/// one (x alone) the slope of its normal upwards, the normal taken on the side of its azimuth.
struct PlaneLean {
  std::int16_t x = 0, y = 0;
};

/// The lean of a plane with this unit normal; slopes beyond ±0.99 are cut off.
PlaneLean lean_of_level(const std::array<double, 3>& normal);
PlaneLean lean_of_wall(const std::array<double, 3>& normal);

/// Collects the leans of clear planes. Sums of integers: the order does not matter.
class LeanSums {
 public:
  void add_level(const PlaneLean& lean);
  void add_wall(const PlaneLean& lean, double azimuth);
  void add(const LeanSums& other);

  /// Where up is, as the level planes say: x and y of its slope. Of several groups of planes, as a floor and
  /// a roof make them, the most level one of at least a quarter of them. 0 0 when there are fewer than 40.
  std::array<double, 2> floors() const;
  /// Whether upright planes stand along up as `slope` says rather than along z: the sum of their distances,
  /// each no more than 3°, so that clutter has little say, is less by more than twice its standard error.
  /// Never when they say nothing, as walls across it.
  bool walls_stand_along(const std::array<double, 2>& slope) const;

 private:
  static constexpr int kBins = 512;  // of 2^-11, 0.028 degrees: slopes up to 0.125
  std::array<std::array<std::uint32_t, kBins>, 2> floors_{};
  static constexpr int kWallBins = 256;  // of 2^-10
  static constexpr int kAzimuths = 32;
  std::array<std::array<std::uint32_t, kWallBins>, kAzimuths> walls_{};
};

/// What a scan's planes say of its being level.
struct Lean {
  std::array<double, 3> up{0, 0, 1};  ///< unit vector
  double degrees = 0;                 ///< between it and z
  bool walls_agree = false;  ///< the walls lean more with the floors than with z: no ramp, but the scan
};

/// By the floors' normals, and more exactly by the heights in `fit`.
Lean lean_of(const LeanSums& sums, const FloorFit& fit = {});

}  // namespace roomcut::ingest

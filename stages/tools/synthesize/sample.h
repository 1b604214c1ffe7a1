// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "stages/tools/synthesize/surfaces.h"

namespace roomcut::synthesize {

/// The placing of a scanner from which some of the points were taken.
struct SetUp {
  std::uint64_t number = 0;     ///< counted from 0, in the order of the blocks
  std::optional<Vec3> station;  ///< where the scanner stood [m]; none: points come from nowhere
};

/// A scan that is made in blocks, in any order and by any number of threads: block b is a pure function of
/// the scene.
class PointSource {
 public:
  virtual ~PointSource() = default;
  virtual std::uint64_t blocks() const = 0;
  /// How many points the whole scan has, or about as many.
  virtual std::uint64_t expected_points() const = 0;
  /// The set-up that a block belongs to.
  virtual SetUp set_up(std::uint64_t block) const = 0;
  /// Appends x, y, z of the block's points [m]. Thread-safe.
  virtual void make(std::uint64_t block, std::vector<float>& xyz) const = 0;
};

/// The scan of a scene with all its copies: evenly over the visible surface, or from tripods. `surfaces` must
/// outlive it.
std::unique_ptr<PointSource> make_source(const Scene& scene, const Building& building,
                                         const Surfaces& surfaces);

/// Where copy number `copy` of the building stands [m].
Vec3 copy_offset(const Scene& scene, const Building& building, std::uint64_t copy);
/// How many copies there are.
std::uint64_t copies(const Scene& scene);

}  // namespace roomcut::synthesize

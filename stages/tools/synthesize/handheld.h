// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/mesh/mesh_tree.h"
#include "stages/tools/synthesize/surfaces.h"

namespace roomcut::synthesize {

/// A vector field that varies smoothly: a sum of cosines whose components have a given standard deviation and
/// a Gaussian correlation over the distance. A pure function of its arguments.
class SmoothField {
 public:
  SmoothField(double sigma_m, double correlation_m, std::uint64_t seed, std::uint64_t stream);
  Vec3 at(const Vec3& p) const;

 private:
  struct Wave {
    Vec3 number, amplitude;
    double phase;
  };
  std::vector<Wave> waves_;  ///< none: zero everywhere
};

/// What phones and depth cameras do to the places that they measure: corners come out round, surfaces warped,
/// and from room to room the position drifts. All copies of a building get the same. Thread-safe.
class Handheld {
 public:
  Handheld(const Scene& scene, const Surfaces& surfaces);
  /// Where the place `p` on a triangle of the surfaces is measured [m], but for noise.
  Vec3 measured(const Vec3& p, const SurfaceTriangle& triangle) const;

 private:
  Vec3 rounded(const Vec3& p, const Vec3& outwards) const;

  double rounding_;
  SmoothField warp_, drift_;
  std::optional<MeshTree> truth_;  ///< only when corners are rounded
};

}  // namespace roomcut::synthesize

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/stairs.h"

namespace roomcut::weigh_faces {

/// Which sloped plane of the complex a point lies on, and which level stands for the plane there.
class Slopes {
 public:
  /// Points within `reach` [m] of a plane, across it, and `rim` of its footprint lie on it.
  Slopes(const CellComplex& complex, double reach, double rim)
      : planes_(complex.planes), stairs_(complex.levels, complex.steps), reach_(reach), rim_(rim) {
    for (const SlopedPlane& plane : planes_) {
      flattening_.push_back(1 / std::sqrt(1 + plane.gradient.squaredNorm()));
    }
  }

  struct Found {
    const SlopedPlane* plane = nullptr;  ///< nullptr = none
    double distance = 0;                 ///< of the point from it [m]
    std::size_t level = 0;               ///< that stands for it at the point
  };

  Found at(const Vec3& point) const {
    Found found;
    found.distance = reach_;
    const Vec2 p = point.head<2>();
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const double distance = std::abs(point.z() - planes_[i].height(p)) * flattening_[i];
      if (distance < found.distance && planes_[i].covers(p, rim_)) {
        found = {&planes_[i], distance, 0};
      }
    }
    if (found.plane != nullptr) {
      found.level = stairs_.level_of(found.plane->height(p));
    }
    return found;
  }

 private:
  const std::vector<SlopedPlane>& planes_;
  std::vector<double> flattening_;  ///< per plane, cosine of its pitch
  Stairs stairs_;
  double reach_, rim_;
};

/// Covers the risers of the stairs that stand for sloped planes as the treads beside them are covered, with
/// the empty side where the plane leaves it: no point lies on them, but the surface passes.
void cover_risers(const CellComplex& complex, FaceWeights& weights);

}  // namespace roomcut::weigh_faces

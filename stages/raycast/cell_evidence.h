// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/raycast/face_walk.h"

namespace roomcut {

/// What speaks for a cell being empty or solid. Each measure by itself; combined in raycast.cpp.
struct CellEvidence {
  double kappa = 0;    ///< share of rays with an odd number of permanent faces (omega > 1/2)
  double winding = 0;  ///< mean of the signed crossings, fronts - backs
  double around = 0;  ///< first hits along the rays, seen through what is not covered: fronts - backs, -1 … 1
  double vertical = 0;               ///< the same straight up and straight down
  double surface_m2 = 0;             ///< fronts - backs on the cell's own faces [m²]
  double front_m2 = 0, back_m2 = 0;  ///< its two parts
  double observed = 0;               ///< share of the rays that end on a seen face
};

/// First hits along a sorted list of crossings: what the ray meets before `limit_m`.
struct FirstHit {
  double signed_hit = 0;  ///< fronts - backs
  double absorbed = 0;    ///< share of the ray that ends on a face
};
FirstHit first_hit(const std::vector<Crossing>& crossings, double limit_m);

/// Casts `rays` rays from random points of the cell. Pure function of its arguments: the random numbers are
/// counted by cell and ray. `scratch` is reused storage.
CellEvidence gather_evidence(const CellComplex& complex, const FaceWeights& weights, const FaceWalk& walk,
                             std::size_t face, std::size_t layer, int rays, std::vector<Crossing>& scratch);

}  // namespace roomcut

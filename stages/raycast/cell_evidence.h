// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/raycast/face_walk.h"

namespace roomcut::raycast {

/// What a ray ends on, seen through what is not covered.
struct FirstHit {
  double front = 0;      ///< share of the ray that ends on a surface's front: the way there is empty
  double back = 0;       ///< share that ends on a back: solid just before it
  double near_back = 0;  ///< the same, fading with the distance: walls and slabs are thin

  double nothing() const;  ///< share that leaves the bounding box
  void add(const FirstHit& other, double weight);
};

/// Evidence for a cell being empty or solid: each measure by itself. raycast.cpp combines them.
struct CellEvidence {
  double kappa = 0;    ///< share of counted rays with an odd number of permanent faces (omega > 1/2)
  double winding = 0;  ///< mean of their signed crossings, fronts - backs
  FirstHit around;     ///< mean over the rays
  FirstHit level;      ///< mean over the level rays
  FirstHit up, down;   ///< mean over columns straight up and down
  double sky = 0;      ///< share of the rising rays that meet nothing
  double front_m2 = 0,
         back_m2 = 0;   ///< covered area of the cell's own faces that shows it its front, its back
  double flat = 0;      ///< covered share of its own floor or ceiling, whichever is larger
  double total_m2 = 0;  ///< area of all its faces
  double volume_m3 = 0;
  double height_m = 0;
  double carved = 0;  ///< share of it that a scanner looked through; 0 when no position is known

  /// 1 for a cell as thin as walls and slabs, 0 for one wider than any, between them linear.
  double thin() const;
  /// Share of the level rays that meet nothing, above a fifth: a room is closed all around but for windows
  /// and doors.
  double open() const;
  /// Share of the columns that meet nothing below, times the share that meets nothing above.
  double outdoors() const;
  /// Share that a scanner looked through, discounted outdoors and inside walls, 0 … 1 (README: line of
  /// sight).
  double looked_through() const;
  /// Share of the columns that end on a back close by, above and below: inside a slab.
  double in_slab() const;
};

/// First hits along a sorted list of crossings.
FirstHit first_hit(const std::vector<Crossing>& crossings);

struct RayRules {
  int rays = 64;             ///< per cell
  bool parity = false;       ///< crossings are counted along all rays, not only along steep ones
  bool from_centre = false;  ///< all rays begin at the cell's centre
  bool level = true;         ///< every other ray is level
};

/// Casts rays from points spread over the cell, or from its centre. Pure function of its arguments; of the
/// cell only its place decides which rays. `scratch` is reused storage.
CellEvidence gather_evidence(const CellComplex& complex, const FaceWeights& weights, const FaceWalk& walk,
                             std::size_t face, std::size_t layer, const RayRules& rules,
                             std::vector<Crossing>& scratch);

}  // namespace roomcut::raycast

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/raycast/face_walk.h"
#include "stages/raycast/first_hit.h"

namespace roomcut::raycast {

/// Evidence for a cell being empty or solid: each measure by itself. raycast.cpp combines them.
struct CellEvidence {
  double kappa = 0;    ///< share of counted rays with an odd number of permanent faces (omega > 1/2)
  double winding = 0;  ///< mean of their signed crossings, fronts - backs
  FirstHit around;     ///< mean over the rays
  FirstHit level;      ///< mean over the level rays
  FirstHit up, down;   ///< mean over columns straight up and down
  LineEnds across;     ///< of level lines
  LineEnds upright;    ///< of lines straight up and down
  double sky = 0;      ///< share of the rising rays that meet nothing
  double front_m2 = 0,
         back_m2 = 0;   ///< covered area of the cell's own faces that shows it its front, its back
  double total_m2 = 0;  ///< area of all its faces
  double volume_m3 = 0;
  double height_m = 0;
  double beyond = 0;        ///< how far it lies beyond the building's envelope, 0 … 1
  double wall_goes_on = 0;  ///< how surely an unseen piece of a wall that was seen elsewhere, 0 … 1
  double carved = 0;        ///< share of it that a scanner looked through; 0 when no position is known

  /// 1 for a cell as thin as walls and slabs, 0 for one wider than any, between them linear.
  double thin() const;
  /// Whether somebody surely looked at it from indoors: walls, floor and ceiling around it show their fronts.
  bool surely_indoors() const;
  /// Share that a scanner looked through, discounted outdoors and inside walls, 0 … 1 (README: line of
  /// sight).
  double looked_through() const;
  /// Share of the columns that end on a back close by, above and below: inside a slab.
  double in_slab() const;
};

struct RayRules {
  int rays = 64;             ///< per cell
  bool parity = false;       ///< crossings are counted along all rays, not only along steep ones
  bool from_centre = false;  ///< all rays begin at the cell's centre
  bool level = true;         ///< half of the rays are level, in pairs that go opposite ways
};

/// Casts rays from points spread over the cell, or from its centre. Pure function of its arguments; of the
/// cell only its place decides which rays. `scratch` is reused storage.
CellEvidence gather_evidence(const CellComplex& complex, const FaceWeights& weights, const FaceWalk& walk,
                             std::size_t face, std::size_t layer, const RayRules& rules,
                             std::vector<Crossing>& scratch);

}  // namespace roomcut::raycast

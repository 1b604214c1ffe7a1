// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/raycast/face_walk.h"

namespace roomcut::raycast {

/// What a ray ends on, seen through what is not covered. Of many rays, the mean.
struct FirstHit {
  double front = 0;      ///< share of the ray that ends on a surface's front: the way there is empty
  double back = 0;       ///< share that ends on a back: solid just before it
  double near_back = 0;  ///< the same, fading with the distance: walls and slabs are thin
  double front_m = 0;    ///< way to the fronts, weighted by `front` [m]
  double back_m = 0;     ///< way to the backs, weighted by `back` [m]

  double nothing() const;  ///< share that leaves the bounding box
  void add(const FirstHit& other, double weight);
};

/// First hits along a sorted list of crossings.
FirstHit first_hit(const std::vector<Crossing>& crossings);

/// From which way between the two ends on a line counts as wide, and as long [m].
struct LineLengths {
  double thin_m;  ///< up to here it is as thin as what cannot be a room …
  double wide_m;  ///< … and from here on not thin at all
  double far_m;   ///< from here on the ends have less and less to do with each other
};

/// What the two ends of lines through a cell are, as shares of all lines. Unlike the size of the cell they do
/// not depend on how the space around it is divided.
struct LineEnds {
  double fronts = 0;          ///< a front at both ends: within what somebody saw
  double backs_thin = 0;      ///< a back at both, thin: inside a wall or a slab
  double backs_wide = 0;      ///< a back at both, wide: between rooms, where nobody was
  double front_back_low = 0;  ///< a front at one, a back at the other, thin
  double one_open = 0;        ///< nothing at one end
  double both_open = 0;       ///< nothing at either

  double open() const { return one_open + both_open; }
  /// The same per line, of a sum over `lines`.
  LineEnds mean(int lines) const;
  /// Adds a line by what is hit on its two ways.
  void add(const FirstHit& one, const FirstHit& other, const LineLengths& lengths, double weight);
};

}  // namespace roomcut::raycast

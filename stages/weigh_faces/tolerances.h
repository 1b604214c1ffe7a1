// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cloud/cloud.h"
#include "stages/weigh_faces/params.h"

namespace roomcut::weigh_faces {

/// The distances of this stage, in metres, derived from noise and density (stages/weigh_faces/README.md).
struct Tolerances {
  double bin;         ///< edge of a coverage bin: 2 tau
  double wall_reach;  ///< largest distance of a wall point from its line
  double
      wall_alone;  ///< a point without a class belongs to a line only if no other passes within this distance
  double wall_tight;  ///< … or if it lies this close to the line, and not to another one that crosses it [m]
  double azimuth;     ///< largest angle between a wall point's normal and its line's [rad]
  double level_reach;              ///< largest distance of a horizontal point from its level
  double level_tight;              ///< the same for points without a class
  double slope_reach;              ///< largest distance of a sloped point from the level it covers
  double beside_low, beside_high;  ///< band beside a wall whose points tell its empty side
  double over_low, over_high;      ///< band above and below a level whose points tell its empty side
  double core_margin;              ///< level faces are judged this far inside their sides
  double top_share;                ///< see WeighFacesParams, as the two below
  bool edge_bins;                  ///< wall_bins: edge
  bool correct_density, slopes;
};

Tolerances resolve_tolerances(const WeighFacesParams& params, const CloudHeader& cloud);

}  // namespace roomcut::weigh_faces

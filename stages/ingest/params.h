// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace roomcut::ingest {

/// What a user may change about `ingest`.
struct IngestParams {
  double voxel_edge_m = 0.05;  ///< finest voxel of the moments; three coarser ones double it each time [m]
  double wall_max_nz = 0.35;   ///< a plane is upright when |nz| of its unit normal is below this
  double level_min_nz = 0.92;  ///< and level when |nz| is above this
  double planar_ratio =
      0.5;  ///< a neighbourhood is a plane when its two smallest variances differ by this factor
  bool drop_ghosts = true;  ///< sparse points far from the building are left out
};

}  // namespace roomcut::ingest

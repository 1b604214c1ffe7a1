// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params/params.h"

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

/// The block `ingest` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(IngestParams& p) {
  return {
      number("voxel_edge_m", p.voxel_edge_m, "m", 0.01, 0.2,
             "Finest voxel of the moments; where points are sparse, edges of 2, 4 and 8 times it are used"),
      number("wall_max_nz", p.wall_max_nz, "1", 0.05, 0.6,
             "A plane is a wall when |nz| of its normal is below"),
      number("level_min_nz", p.level_min_nz, "1", 0.7, 0.999,
             "A plane is a floor or ceiling when |nz| of its normal is above"),
      boolean("drop_ghosts", p.drop_ghosts,
              "Sparse points far from the building, from mirrors, glass and the sky, are left out."),
      number("planar_ratio", p.planar_ratio, "1", 0.05, 0.9,
             "Points lie on a plane when their smallest variance is below this share of the middle one"),
  };
}

}  // namespace roomcut::ingest

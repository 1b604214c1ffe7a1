// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/cloud/cloud.h"
#include "stages/ingest/coverage.h"
#include "stages/ingest/estimates.h"
#include "stages/ingest/lean.h"
#include "stages/ingest/params.h"
#include "stages/ingest/tile_grid.h"

namespace roomcut::ingest {

/// What a neighbourhood of 27 voxels says about the surface in its middle.
struct VoxelSurface {
  SurfaceClass surface = SurfaceClass::kNone;
  std::uint8_t azimuth = 0;
  bool resolved = false;    ///< enough points, and not all on one line: coarser voxels need not be asked
  bool whole = false;       ///< no holes in the neighbourhood but by chance
  bool undecided = false;   ///< chance alone may have put the plane test on this side
  float tilt_variance = 0;  ///< of the plane's direction, lambda0 / (n lambda1) [rad^2]
  float area = 0;           ///< area per point [m^2]
  PlaneLean lean;           ///< of level planes and walls
  float noise =
      0;  ///< standard deviation off the plane; 0 when the voxel is not well filled or no clear plane [m]
};

/// Sums over a neighbourhood.
struct NeighbourSum {
  Moments moments;
  VoxelMask mask = 0;
};

/// Fits the plane, classes it and estimates the area that each point stands for.
VoxelSurface surface_of(const NeighbourSum& sum, const std::array<std::uint32_t, 3>& centre,
                        double voxel_edge_m, double unit_m, const IngestParams& params);

/// Classes every voxel of a tile, each at the finest level that has enough points. Scratch memory is kept
/// between tiles.
class SurfaceFinder {
 public:
  explicit SurfaceFinder(const IngestParams& params) : params_(params) {}

  /// The surface per voxel of level 0 inside the tile; voxels of the halo stay as they are made. Adds to
  /// `estimates`.
  const std::vector<VoxelSurface>& find(const TileGrid& grid, const UnitScale& scale,
                                        SurfaceEstimates& estimates);

 private:
  struct Cached {
    VoxelSurface surface;
    bool known = false;
  };
  /// Counts the neighbourhoods of a coarse level; fits those that will be asked for certainly.
  void survey(const TileGrid& grid, const UnitScale& scale, int level);
  VoxelSurface fit_coarse(const TileGrid& grid, const UnitScale& scale, int level, std::uint32_t voxel,
                          int ix, int iy) const;
  const VoxelSurface& at_coarse(const TileGrid& grid, const UnitScale& scale, int level, std::uint32_t voxel,
                                int ix, int iy);
  /// The surface of voxel `voxel` at its own level 0 or at that of one of its ancestors.
  VoxelSurface choose(const TileGrid& grid, const UnitScale& scale, std::uint32_t voxel, int ix, int iy,
                      Neighbourhood& around);

  IngestParams params_;
  std::array<std::vector<std::uint32_t>, fixed_grid::kLevels>
      counts_;                                                  ///< points of the neighbourhood, levels 1 …
  std::array<std::vector<Cached>, fixed_grid::kLevels> cache_;  ///< levels 1 …
  std::vector<VoxelSurface> result_;
};

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "stages/slice/voxels.h"

namespace roomcut::slice {

/// Voxels side by side whose points lie on one plane.
struct PlanarRegion {
  std::vector<std::uint32_t> voxels;  ///< ascending
  Moments moments;
  SpacePlane plane;
};

/// What counts as lying on one plane.
struct RegionRules {
  double noise_m = 0;
  double apart_m = 0;    ///< farthest that the middle of a voxel lies from the plane
  double turned = 0;     ///< largest angle of its own plane with it [rad]
  double min_pitch = 0;  ///< of the voxels that begin a region or join one [rad]
  double max_pitch = 0;
};

/// Marks in `taken` the voxels of level surfaces in blocks of 4 x 4 voxels: level within 0.3 degrees and flat
/// within noise.
void level_blocks(const std::vector<SurfaceVoxel>& voxels, double noise_m, std::vector<std::uint8_t>& taken);

/// The plane of each voxel and the neighbours that lie on it.
struct VoxelPatch {
  SpacePlane plane;
  double area_m2 = 0;  ///< 0 = there is no clear plane
};

/// Of the voxels that are free in `taken`. Parallel, deterministic.
std::vector<VoxelPatch> voxel_patches(const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
                                      double noise_m, const std::vector<std::uint8_t>& taken);

/// Grows regions of at least `min_m2` from the clearest voxels on, over the voxels that are still free in
/// `taken`, and marks theirs with `taken[i] = 1`. Deterministic.
std::vector<PlanarRegion> grow_regions(const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
                                       const std::vector<VoxelPatch>& patches, const RegionRules& rules,
                                       double min_m2, std::vector<std::uint8_t>& taken);

}  // namespace roomcut::slice

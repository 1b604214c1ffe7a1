// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stages/slice/regions.h"

namespace roomcut::slice {

/// For each of so many voxels the region that it belongs to, or -1.
std::vector<std::int32_t> regions_of(const std::vector<PlanarRegion>& regions, std::size_t voxels);

/// Gives voxels between two regions to the one whose plane is nearer, and fits both again. The order in which
/// regions grew has no say then.
void settle_borders(std::vector<PlanarRegion>& regions, const std::vector<SurfaceVoxel>& voxels,
                    const VoxelGraph& graph, double apart_m);

/// Joins regions of at least that pitch that lie on one plane less than about 1 m apart: a wall or a dormer
/// parts a roof. Deterministic.
void merge_regions(std::vector<PlanarRegion>& regions, const std::vector<SurfaceVoxel>& voxels,
                   double noise_m, double min_pitch);

}  // namespace roomcut::slice

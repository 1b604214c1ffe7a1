// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "stages/slice/regions.h"

namespace roomcut::slice {

/// Facets of what slopes but is no plane, as vaults and domes are: the voxels' middles lie within 6 cm of
/// them, with an rms below 4 cm (or 2 noise). One has at least 0.8 m^2; those side by side 4 m^2, or one of
/// them 2 m^2. Facets of less than 12 degrees count beside steeper facets or `planes` only, at a crown: alone
/// they are drift. Takes voxels that are free in `taken` and marks them. Deterministic.
std::vector<PlanarRegion> find_facets(const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
                                      const std::vector<VoxelPatch>& patches,
                                      const std::vector<PlanarRegion>& planes, double noise_m,
                                      std::vector<std::uint8_t>& taken);

}  // namespace roomcut::slice

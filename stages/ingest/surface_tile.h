// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cloud/cloud.h"
#include "stages/ingest/surface.h"

namespace roomcut {

/// Writes the tile's own points (not its halo's) into `out`, sorted by class, then voxel, then file order. A
/// point's own normal, where the file has one, decides its class and azimuth; but where the normals of a tile
/// contradict the planes that its points lie on (more than 30 % of the points on clear planes), they are left
/// aside. Returns whether they were.
bool make_cloud_tile(const TileGrid& grid, const std::vector<VoxelSurface>& surfaces, bool hints,
                     CloudTile& out);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cloud/cloud.h"
#include "stages/ingest/surface.h"

namespace roomcut::ingest {

/// Whether the file's normals contradict the planes that the points of a tile lie on: more than 30 % of the
/// points on clear planes. Then they are left aside there.
class NormalsCheck {
 public:
  /// The points of the grid's last band, without the tile's halo.
  void add(const TileGrid& grid, const std::vector<VoxelSurface>& surfaces);
  bool refused() const;

 private:
  std::uint64_t both_ = 0;   ///< points with a normal on a clear plane
  std::uint64_t equal_ = 0;  ///< of the same class in both
};

/// Writes the tile's own points (not its halo's) in the grid's last band into `out`, sorted by class, then
/// voxel, then file order. With `use_normals` a point's own normal, where the file has one, decides its class
/// and azimuth.
void make_cloud_part(const TileGrid& grid, const std::vector<VoxelSurface>& surfaces, bool use_normals,
                     CloudTile& out);

}  // namespace roomcut::ingest

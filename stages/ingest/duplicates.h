// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "stages/ingest/tile_grid.h"

namespace roomcut::ingest {

/// Counts points that repeat another one's coordinates, as a file holds them that was written twice over, or
/// whose scans overlap with themselves. One for each thread.
class DuplicateCounter {
 public:
  /// Points of the last band of `grid`, its halo left out, without whom the coordinates of all of them were
  /// distinct. One voxel of sixteen is looked at first, and the others only where that has some: exact where
  /// duplicates are more than a few, 0 where the sample has none. Equal are coordinates that are so as local
  /// float32, within 0.1 mm. Deterministic.
  std::uint64_t count(const TileGrid& grid);

 private:
  std::uint64_t count_voxel(const TileGrid& grid, std::uint32_t first, std::uint32_t last);
  std::vector<std::uint64_t> keys_;
};

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stages/ingest/fixed_grid.h"
#include "stages/ingest/moments.h"

namespace roomcut::ingest {

/// Occupied voxels of one edge length in a tile and its halo, by column (row-major in plan), upwards in a
/// column.
struct VoxelLevel {
  int level = 0;
  int columns = 0;                   ///< along one side, halo included
  std::vector<std::uint32_t> begin;  ///< first voxel of each column; size columns^2 + 1
  std::vector<std::uint16_t> z;      ///< height of a voxel above the tile's base, in voxels of this level
  std::vector<Moments> moments;
  std::vector<std::uint32_t> points;  ///< of each voxel, as its moments say too, but sixteen to a cache line;
                                      ///< empty on the finest level
  std::vector<std::uint32_t>
      parent;  ///< the voxel of the next level that contains this one; empty on the last

  std::size_t size() const { return z.size(); }
  int halo() const { return fixed_grid::kHaloVoxels >> level; }  ///< columns of halo on each side
  std::size_t column(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(ix);
  }
  void clear(int at_level);
  void reserve(std::size_t voxels);
};

/// Joins 2 × 2 × 2 voxels each into `coarse` and notes the parents in `fine`.
void coarsen(VoxelLevel& fine, VoxelLevel& coarse);

/// The 3 × 3 columns around a column, walked upwards together.
class Neighbourhood {
 public:
  /// The column must not lie on the edge of the halo, or have nothing beyond it: columns outside count as
  /// empty.
  Neighbourhood(const VoxelLevel& level, int ix, int iy) : level_(level) {
    for (int k = 0; k < 9; ++k) {
      const int cx = ix + k % 3 - 1;
      const int cy = iy + k / 3 - 1;
      const bool inside = cx >= 0 && cy >= 0 && cx < level.columns && cy < level.columns;
      const std::size_t column = inside ? level.column(cx, cy) : 0;
      at_[static_cast<std::size_t>(k)] = inside ? level.begin[column] : 0;
      end_[static_cast<std::size_t>(k)] = inside ? level.begin[column + 1] : 0;
    }
  }

  /// Calls visit(voxel, bit) for each occupied voxel of the 27 around height z; bit = 3·(column of the nine)
  /// + (0, 1, 2 upwards). Heights must not decrease from one call to the next.
  template <class Visit>
  void visit(std::uint16_t z, Visit&& visit) {
    const std::uint16_t* const heights = level_.z.data();
    for (std::size_t k = 0; k < 9; ++k) {
      std::uint32_t voxel = at_[k];
      const std::uint32_t end = end_[k];
      while (voxel < end && heights[voxel] + 1 < z) {
        ++voxel;
      }
      at_[k] = voxel;
      for (; voxel < end && heights[voxel] <= z + 1; ++voxel) {
        visit(voxel, static_cast<int>(3 * k) + heights[voxel] - z + 1);
      }
    }
  }

 private:
  const VoxelLevel& level_;
  std::array<std::uint32_t, 9> at_{};
  std::array<std::uint32_t, 9> end_{};
};

}  // namespace roomcut::ingest

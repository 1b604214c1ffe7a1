// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/voxel_level.h"

#include <algorithm>

namespace roomcut::ingest {

void VoxelLevel::clear(int at_level) {
  level = at_level;
  columns = (fixed_grid::kTileVoxels + 2 * fixed_grid::kHaloVoxels) >> at_level;
  begin.clear();
  z.clear();
  moments.clear();
  points.clear();
  parent.clear();
}

void VoxelLevel::reserve(std::size_t voxels) {
  z.reserve(voxels);
  moments.reserve(voxels);
}

namespace {

/// Joins the voxels of four neighbouring columns, from below, `at` running to `end` in each, into one column.
void join_columns(VoxelLevel& fine, VoxelLevel& coarse, std::array<std::uint32_t, 4>& at,
                  const std::array<std::uint32_t, 4>& end) {
  while (true) {
    int lowest = INT32_MAX;
    for (std::size_t k = 0; k < 4; ++k) {
      lowest = at[k] < end[k] ? std::min(lowest, fine.z[at[k]] / 2) : lowest;
    }
    if (lowest == INT32_MAX) {
      return;
    }
    const auto voxel = static_cast<std::uint32_t>(coarse.size());
    coarse.z.push_back(static_cast<std::uint16_t>(lowest));
    MomentSum sum;
    for (std::size_t k = 0; k < 4; ++k) {
      for (; at[k] < end[k] && fine.z[at[k]] / 2 == lowest; ++at[k]) {
        sum.add(fine.moments[at[k]]);
        fine.parent[at[k]] = voxel;
      }
    }
    coarse.moments.push_back(sum.total());
    coarse.points.push_back(coarse.moments.back().points());
  }
}

}  // namespace

void coarsen(VoxelLevel& fine, VoxelLevel& coarse) {
  coarse.clear(fine.level + 1);
  fine.parent.resize(fine.size());
  coarse.begin.reserve(static_cast<std::size_t>(coarse.columns) * static_cast<std::size_t>(coarse.columns) +
                       1);
  coarse.reserve(fine.size() / 2);
  for (int iy = 0; iy < coarse.columns; ++iy) {
    for (int ix = 0; ix < coarse.columns; ++ix) {
      coarse.begin.push_back(static_cast<std::uint32_t>(coarse.size()));
      std::array<std::uint32_t, 4> at{};
      std::array<std::uint32_t, 4> end{};
      for (int k = 0; k < 4; ++k) {
        const std::size_t column = fine.column(2 * ix + k % 2, 2 * iy + k / 2);
        at[static_cast<std::size_t>(k)] = fine.begin[column];
        end[static_cast<std::size_t>(k)] = fine.begin[column + 1];
      }
      join_columns(fine, coarse, at, end);
    }
  }
  coarse.begin.push_back(static_cast<std::uint32_t>(coarse.size()));
}

}  // namespace roomcut::ingest

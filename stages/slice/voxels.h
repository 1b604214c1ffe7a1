// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "stages/slice/cell_table.h"
#include "stages/slice/fixed_point.h"
#include "stages/slice/moments.h"

namespace roomcut::slice {

/// Horizontal and sloped points of one voxel.
struct SurfaceVoxel {
  CellKey key{0, 0, 0};
  std::int32_t count = 0;
  Moments moments;
};

/// Edges of the voxels: whole cells of the plan raster, about 30 cm; half as high, so that both sides of a
/// slab fall into different ones.
struct VoxelSize {
  double plan_m = 0, height_m = 0;
  double per_plan = 0, per_height = 0;  ///< voxels per metre
  CellKey at(const Vec3& p) const {
    return {floor_to_int(p.x() * per_plan), floor_to_int(p.y() * per_plan), floor_to_int(p.z() * per_height)};
  }
};
VoxelSize voxel_size(double raster_m);

/// Sums over the points of one voxel, from its corner on; integers, so that they do not depend on the order.
struct VoxelSum {
  std::int64_t count = 0, area = 0;
  std::int64_t x = 0, y = 0, z = 0;
  std::int64_t xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  VoxelSum& operator+=(const VoxelSum& other);
};

/// Adds a point of that area.
void add_to_voxel(CellTable<VoxelSum>& table, const VoxelSize& size, const Vec3& point, double area_m2);

/// The voxels, in the order of the entries.
std::vector<SurfaceVoxel> to_voxels(const std::vector<CellEntry<VoxelSum>>& entries, const VoxelSize& size);

/// Calls `visit(j)` for every voxel j whose indices differ from the key's by at most `plan` and `height`,
/// ascending. `voxels` must be sorted by column.
template <class Visit>
void for_each_near(const std::vector<SurfaceVoxel>& voxels, const CellKey& key, std::int32_t plan,
                   std::int32_t height, const Visit& visit) {
  for (std::int32_t iy = key.iy - plan; iy <= key.iy + plan; ++iy) {
    const CellKey from{key.ix - plan, iy, key.iz - height};
    auto j = std::lower_bound(voxels.begin(), voxels.end(), from,
                              [](const SurfaceVoxel& v, const CellKey& k) { return by_column(v.key, k); });
    for (; j != voxels.end() && j->key.iy == iy && j->key.ix <= key.ix + plan; ++j) {
      if (std::abs(j->key.iz - key.iz) <= height) visit(static_cast<std::size_t>(j - voxels.begin()));
    }
  }
}

/// The up to 26 voxels beside each one: voxel i has those of neighbours[first[i]] … neighbours[first[i + 1] −
/// 1], ascending.
struct VoxelGraph {
  std::vector<std::uint32_t> first, neighbours;
};

/// `voxels` must be sorted by column; those marked in `without` have none. Parallel, deterministic.
VoxelGraph voxel_graph(const std::vector<SurfaceVoxel>& voxels, const std::vector<std::uint8_t>& without);

}  // namespace roomcut::slice

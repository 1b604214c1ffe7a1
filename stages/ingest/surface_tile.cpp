// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/surface_tile.h"

#include <array>

namespace roomcut {

namespace {

constexpr std::size_t kClasses = 4;
constexpr double kLeastAgreement = 0.7;

struct Surface {
  std::uint8_t surface;
  std::uint8_t azimuth;
};

Surface surface_of_point(const TileGrid::Point& point, const VoxelSurface& voxel, bool hints) {
  if (hints && point.hint != 0) {
    return {static_cast<std::uint8_t>(point.hint & 0xff), static_cast<std::uint8_t>(point.hint >> 8)};
  }
  return {static_cast<std::uint8_t>(voxel.surface), voxel.azimuth};
}

/// Calls visit(voxel, first point, last + 1) for the voxels of the tile without its halo.
template <class Visit>
void for_own_voxels(const TileGrid& grid, Visit&& visit) {
  const VoxelLevel& level = grid.level(0);
  const std::vector<std::uint32_t>& first = grid.first_point();
  for (int iy = level.halo(); iy < level.columns - level.halo(); ++iy) {
    for (int ix = level.halo(); ix < level.columns - level.halo(); ++ix) {
      const std::size_t column = level.column(ix, iy);
      for (std::uint32_t voxel = level.begin[column]; voxel < level.begin[column + 1]; ++voxel) {
        visit(voxel, first[voxel], first[voxel + 1]);
      }
    }
  }
}

/// Calls visit(point, voxel's surface) for the points of the tile without its halo.
template <class Visit>
void for_own_points(const TileGrid& grid, const std::vector<VoxelSurface>& surfaces, Visit&& visit) {
  for_own_voxels(grid, [&](std::uint32_t voxel, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t i = first; i < last; ++i) {
      visit(grid.points()[i], surfaces[voxel]);
    }
  });
}

bool hints_agree(const TileGrid& grid, const std::vector<VoxelSurface>& surfaces) {
  std::uint64_t both = 0;
  std::uint64_t equal = 0;
  for_own_points(grid, surfaces, [&](const TileGrid::Point& point, const VoxelSurface& voxel) {
    if (voxel.noise > 0 && point.hint != 0) {
      ++both;
      equal += (point.hint & 0xff) == static_cast<unsigned>(voxel.surface) ? 1 : 0;
    }
  });
  return static_cast<double>(equal) >= kLeastAgreement * static_cast<double>(both);
}

void resize(CloudTile& tile, std::size_t points) {
  tile.x.resize(points);
  tile.y.resize(points);
  tile.z.resize(points);
  tile.surface.resize(points);
  tile.azimuth.resize(points);
  tile.area.resize(points);
}

}  // namespace

bool make_cloud_tile(const TileGrid& grid, const std::vector<VoxelSurface>& surfaces, bool hints,
                     CloudTile& out) {
  const bool refused = hints && !hints_agree(grid, surfaces);
  const bool use = hints && !refused;
  std::array<std::size_t, kClasses> next{};
  if (use) {
    for_own_points(grid, surfaces, [&](const TileGrid::Point& point, const VoxelSurface& voxel) {
      ++next[surface_of_point(point, voxel, use).surface];
    });
  } else {
    for_own_voxels(grid, [&](std::uint32_t voxel, std::uint32_t first, std::uint32_t last) {
      next[static_cast<std::size_t>(surfaces[voxel].surface)] += last - first;
    });
  }
  std::size_t total = 0;
  for (std::size_t& begin : next) {
    const std::size_t count = begin;
    begin = total;
    total += count;
  }
  resize(out, total);
  for_own_points(grid, surfaces, [&](const TileGrid::Point& point, const VoxelSurface& voxel) {
    const Surface surface = surface_of_point(point, voxel, use);
    const std::size_t at = next[surface.surface]++;
    out.x[at] = point.x;
    out.y[at] = point.y;
    out.z[at] = point.z;
    out.surface[at] = surface.surface;
    out.azimuth[at] = surface.azimuth;
    out.area[at] = voxel.area;
  });
  return refused;
}

}  // namespace roomcut

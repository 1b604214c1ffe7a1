// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/surface_tile.h"

#include <array>

namespace roomcut::ingest {

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

/// Calls visit(point, voxel's surface) for the points of for_own_voxels().
template <class Visit>
void for_own_points(const TileGrid& grid, const std::vector<VoxelSurface>& surfaces, Visit&& visit) {
  for_own_voxels(grid, [&](std::uint32_t voxel, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t i = first; i < last; ++i) {
      visit(grid.points()[i], surfaces[voxel]);
    }
  });
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

void NormalsCheck::add(const TileGrid& grid, const std::vector<VoxelSurface>& surfaces) {
  for_own_points(grid, surfaces, [&](const TileGrid::Point& point, const VoxelSurface& voxel) {
    if (voxel.noise > 0 && point.hint != 0) {
      ++both_;
      equal_ += (point.hint & 0xff) == static_cast<unsigned>(voxel.surface) ? 1 : 0;
    }
  });
}

bool NormalsCheck::refused() const {
  return static_cast<double>(equal_) < kLeastAgreement * static_cast<double>(both_);
}

void make_cloud_part(const TileGrid& grid, const std::vector<VoxelSurface>& surfaces, bool use_normals,
                     CloudTile& out) {
  std::array<std::size_t, kClasses> next{};
  if (use_normals) {
    for_own_points(grid, surfaces, [&](const TileGrid::Point& point, const VoxelSurface& voxel) {
      ++next[surface_of_point(point, voxel, use_normals).surface];
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
    const Surface surface = surface_of_point(point, voxel, use_normals);
    const std::size_t at = next[surface.surface]++;
    out.x[at] = point.x;
    out.y[at] = point.y;
    out.z[at] = point.z;
    out.surface[at] = surface.surface;
    out.azimuth[at] = surface.azimuth;
    out.area[at] = voxel.area;
  });
}

}  // namespace roomcut::ingest

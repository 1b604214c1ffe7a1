// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace roomcut::ingest {

/// The grid that everything in `ingest` stands on. A voxel edge is divided into 1024 units, so voxels, their
/// coarser parents and tiles follow from an integer coordinate by shifts, sums of coordinates are exact and
/// therefore the same in any order, and a tile's border lies on the border of the coarsest voxels.
namespace fixed_grid {

inline constexpr int kVoxelBits = 10;  ///< units in the finest voxel edge: 2^10
inline constexpr int kTileBits = 17;   ///< units in a tile's edge: 2^17, i.e. 128 voxels (6.4 m)
inline constexpr int kLevels = 4;      ///< voxel edges 1, 2, 4, 8
inline constexpr int kTileVoxels = 1 << (kTileBits - kVoxelBits);
inline constexpr int kHaloVoxels = 1 << (kLevels - 1);  ///< one voxel of the coarsest level
inline constexpr std::int32_t kTileUnits = 1 << kTileBits;
inline constexpr std::int32_t kHaloUnits = kHaloVoxels << kVoxelBits;
inline constexpr int kWindowTiles = 1024;  ///< tiles along each side of the plan that is looked at (6.5 km)
inline constexpr int kWindowLayers = 64;   ///< tile edges in height that are looked at (410 m)

}  // namespace fixed_grid

/// Metres to units, rounding down.
class UnitScale {
 public:
  explicit UnitScale(double voxel_edge_m)
      : units_per_m_(static_cast<float>((1 << fixed_grid::kVoxelBits) / voxel_edge_m)),
        voxel_edge_m_(voxel_edge_m) {}
  std::int32_t units(float metres) const {
    const float scaled = metres * units_per_m_;
    const auto truncated = static_cast<std::int32_t>(scaled);
    return truncated - (static_cast<float>(truncated) > scaled ? 1 : 0);
  }
  double voxel_edge_m() const { return voxel_edge_m_; }
  double unit_m() const { return voxel_edge_m_ / (1 << fixed_grid::kVoxelBits); }
  double tile_edge_m() const { return voxel_edge_m_ * fixed_grid::kTileVoxels; }

 private:
  float units_per_m_;
  double voxel_edge_m_;
};

/// Columns of a tile with its halo, row by row, from `begin` to before `end`; all of them by default.
struct TileColumns {
  static constexpr int kAlong = fixed_grid::kTileVoxels + 2 * fixed_grid::kHaloVoxels;  ///< in a row
  int begin = 0;
  int end = kAlong * kAlong;
};

/// The column of a point in tile (ix, iy) or its halo.
inline int column_of(float x, float y, std::int32_t ix, std::int32_t iy, const UnitScale& scale) {
  using namespace fixed_grid;
  const std::int32_t column = (scale.units(x) - (ix * kTileUnits - kHaloUnits)) >> kVoxelBits;
  const std::int32_t row = (scale.units(y) - (iy * kTileUnits - kHaloUnits)) >> kVoxelBits;
  return row * TileColumns::kAlong + column;
}

}  // namespace roomcut::ingest

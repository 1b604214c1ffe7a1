// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "stages/ingest/scan_frame.h"
#include "stages/ingest/tile_store.h"
#include "stages/ingest/voxel_level.h"

namespace roomcut::ingest {

/// A tile's place, in tile edges from the local origin, and the kept layers of it and the eight around it
/// (row-major, itself in the middle; bit i: layer i above `window_z`).
struct TilePlace {
  std::int32_t ix = 0, iy = 0;
  std::int32_t window_z = 0;
  std::array<std::uint64_t, 9> layers{};
  bool distinct = false;  ///< of points with the same coordinates only the first is taken
};

/// The points of one tile and its halo sorted by voxel, and their moments at every level. A tile with many
/// points is built from bands of columns, one after the other: their moments stay, only the last band's
/// points do.
class TileGrid {
 public:
  struct Point {
    float x, y, z;
    std::uint16_t hint;
    std::uint16_t height;  ///< of its voxel above the tile's base
  };

  /// Sorts by (column, height); points of one voxel keep file order. Time linear in the points.
  void build(const TileRuns& runs, const TilePlace& place, const UnitScale& scale);

  /// The same in bands: begin(), from the first without a gap sort_columns() and sum_moments(), finish().
  /// Afterwards bands may be sorted again. `lowest_z` [m] is that of all points.
  void begin(const TilePlace& place, float lowest_z, const UnitScale& scale);
  void sort_columns(const TileRuns& runs, const TileColumns& columns, const TilePlace& place,
                    const UnitScale& scale);
  void sum_moments(const UnitScale& scale);
  void finish();

  /// Of the last band.
  const std::vector<Point>& points() const { return sorted_; }
  const TileColumns& columns() const { return columns_; }
  /// How many of them lie in the tile, not in its halo.
  std::uint64_t own_points() const;
  VoxelLevel& level(int i) { return levels_[static_cast<std::size_t>(i)]; }
  const VoxelLevel& level(int i) const { return levels_[static_cast<std::size_t>(i)]; }
  /// Centre of a voxel in units from the tile's corner, as the moments count.
  std::array<std::uint32_t, 3> centre(int level, int ix, int iy, std::uint16_t z) const;

 private:
  void find_keys(const TileRuns& runs, const TilePlace& place, const UnitScale& scale);
  void sort_keyed(const TileRuns& runs, bool distinct);
  void sort_column(std::size_t first, std::size_t last);
  std::size_t move_distinct(std::size_t first, std::size_t last, std::size_t to);

  std::array<std::int32_t, 3>
      corner_{};  ///< of the halo, local units; the base in height is a coarsest voxel's
  std::vector<std::uint16_t> column_, height_;  ///< per input point; column kDropped = not kept
  std::vector<std::uint32_t> columns_begin_;
  std::vector<std::uint32_t> heights_begin_;  ///< of one column
  std::vector<Point> column_points_, sorted_;
  std::vector<std::pair<std::uint64_t, std::size_t>> keys_;  ///< of one column's points
  std::vector<std::size_t> firsts_;                          ///< of them with the same coordinates
  std::size_t voxels_ =
      0;  ///< of the sorted points: room for one per point would be three times what is needed
  TileColumns columns_;
  std::array<VoxelLevel, fixed_grid::kLevels> levels_;
};

/// Calls visit(voxel, first point, last + 1) for the voxels of the last band without the tile's halo.
template <class Visit>
void for_own_voxels(const TileGrid& grid, Visit&& visit) {
  const VoxelLevel& level = grid.level(0);
  const int halo = level.halo();
  std::uint32_t first = 0;
  for (int k = grid.columns().begin; k < grid.columns().end; ++k) {
    const int iy = k / level.columns;
    const int ix = k % level.columns;
    const bool own = iy >= halo && iy < level.columns - halo && ix >= halo && ix < level.columns - halo;
    const auto column = static_cast<std::size_t>(k);
    for (std::uint32_t voxel = level.begin[column]; voxel < level.begin[column + 1]; ++voxel) {
      const std::uint32_t last = first + level.moments[voxel].points();
      if (own) visit(voxel, first, last);
      first = last;
    }
  }
}

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "stages/ingest/surface_tile.h"
#include "stages/ingest/tile_store.h"

namespace roomcut::ingest {

/// A tile with more points than memory should hold at once. They are taken from the store in bands of
/// columns, once for the moments, from which the surfaces follow as for any tile, and once to be handed on.
/// Memory: the voxels, and the points of one band.
class LargeTile {
 public:
  /// A band has at most `band_points`, or one column: a row may hold millions, when a wall runs along it.
  /// `store` must outlive this.
  LargeTile(const TileStore& store, std::uint32_t tile, const TilePlace& place, const UnitScale& scale,
            const IngestParams& params, std::uint64_t band_points);

  /// The tile's own points, those left out that repeat others.
  std::uint64_t count_points();

  /// First: the surfaces, as SurfaceFinder. Returns whether the file's normals were refused.
  bool find_surfaces(SurfaceEstimates& estimates);

  /// Then: calls take(points, last) with the tile's own points band by band, each sorted by class, then
  /// voxel, then file order.
  void hand_over(const std::function<void(const CloudTile&, bool)>& take);

 private:
  struct Band {
    TileColumns columns;
    std::uint64_t first = 0, points = 0;  ///< of the file
  };
  struct Record {
    float x, y, z;
    std::uint16_t hint;
    std::uint16_t unused = 0;  // no byte of the file is left to chance
  };
  void cut_bands(const std::vector<std::uint32_t>& column_points, std::uint64_t band_points);
  void fill_file();
  void sort_band(const Band& band);

  const TileStore& store_;
  std::uint32_t tile_;
  TilePlace place_;
  UnitScale scale_;
  std::vector<Band> bands_;
  ScratchFile file_;
  std::vector<Record> records_;
  TilePoints points_;
  TileGrid grid_;
  SurfaceFinder finder_;
  const std::vector<VoxelSurface>* surfaces_ = nullptr;  ///< of finder_
  bool use_normals_ = false;
};

}  // namespace roomcut::ingest

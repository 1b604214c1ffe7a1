// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/tile_place.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "stages/ingest/large_tile.h"

namespace roomcut::ingest {

namespace {

std::uint64_t layers_of(const std::vector<KeptTile>& tiles, std::uint32_t tile) {
  const auto found =
      std::lower_bound(tiles.begin(), tiles.end(), tile,
                       [](const KeptTile& kept, std::uint32_t wanted) { return kept.tile < wanted; });
  return found != tiles.end() && found->tile == tile ? found->layers : 0;
}

struct Sorting {
  TilePoints loaded;
  TileRuns runs;
  TileGrid grid;
};

std::uint64_t count_tile(const TiledScan& scan, const KeptTile& tile, const UnitScale& scale,
                         Sorting& sorting) {
  scan.store->gather(tile.tile, sorting.loaded, sorting.runs);
  const TilePlace place = place_of(scan, tile);
  sorting.grid.begin(place, lowest_of(sorting.runs), scale);
  sorting.grid.sort_columns(sorting.runs, {}, place, scale);
  return sorting.grid.own_points();
}

}  // namespace

TilePlace place_of(const TiledScan& scan, const KeptTile& tile) {
  constexpr int kTiles = fixed_grid::kWindowTiles;
  const int column = static_cast<int>(tile.tile % kTiles);
  const int row = static_cast<int>(tile.tile / kTiles);
  TilePlace place{
      column + scan.frame.window[0], row + scan.frame.window[1], scan.frame.window[2], {}, scan.distinct};
  for (int k = 0; k < 9; ++k) {
    const int other_column = column + k % 3 - 1;
    const int other_row = row + k / 3 - 1;
    const bool inside = other_column >= 0 && other_row >= 0 && other_column < kTiles && other_row < kTiles;
    place.layers[static_cast<std::size_t>(k)] =
        inside ? layers_of(scan.tiles, static_cast<std::uint32_t>(other_row * kTiles + other_column)) : 0;
  }
  return place;
}

bool is_large(const TiledScan& scan, const KeptTile& tile) {
  return tile.points + tile.repeated > 4 * scan.band_points;
}

void leave_out_duplicates(TiledScan& scan, const IngestParams& params) {
  scan.distinct = true;
  const UnitScale scale(params.voxel_edge_m);
  tbb::enumerable_thread_specific<Sorting> sortings;
  std::vector<std::uint64_t> distinct(scan.tiles.size());
  tbb::parallel_for(std::size_t{0}, scan.tiles.size(), [&](std::size_t i) {
    const KeptTile& tile = scan.tiles[i];
    distinct[i] = is_large(scan, tile) ? LargeTile(*scan.store, tile.tile, place_of(scan, tile), scale,
                                                   params, scan.band_points)
                                             .count_points()
                                       : count_tile(scan, tile, scale, sortings.local());
  });
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    KeptTile& tile = scan.tiles[i];
    tile.repeated = tile.points - distinct[i];
    tile.points = distinct[i];
    scan.counts.duplicates += tile.repeated;
  }
  scan.counts.kept -= scan.counts.duplicates;
}

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/errors/codes.h"
#include "stages/ingest/duplicates.h"
#include "stages/ingest/ingest.h"
#include "stages/ingest/quantisation.h"
#include "stages/ingest/scan_middle.h"
#include "stages/ingest/tile_place.h"

namespace roomcut::ingest {

namespace {

constexpr std::uint64_t kFewestPoints = 100;
constexpr double kLargestFarShare = 0.1;  // more points beyond the window than this are no ghosts
constexpr double kLargest_m = 2000;
constexpr double kSmallest_m = 0.5;
constexpr double kReach_m = 3000;         // of the points that say where the scan lies
constexpr double kManyDuplicates = 0.01;  // of the points: fewer may come of rounded coordinates
constexpr double kCoarsest_m = 0.11;      // steps of 6 cm still give walls, of 12 cm none

void read_block(const ScanReader& reader, std::size_t index, ScanBlock& block) {
  block.no_returns = 0;
  reader.read(index, block);
  block.drop_no_returns();
}

/// The first block that has a finite point: what frame and quantisation are judged by.
ScanBlock first_useful_block(const ScanReader& reader) {
  ScanBlock block;
  for (std::size_t i = 0; i < reader.blocks(); ++i) {
    read_block(reader, i, block);
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (std::isfinite(block.x[k]) && std::isfinite(block.y[k]) && std::isfinite(block.z[k])) {
        return block;
      }
    }
  }
  return block;
}

struct BlockCounts {
  std::uint64_t points = 0, no_returns = 0, not_finite = 0, far = 0;
};

/// What one thread needs to sort blocks.
struct Sorting {
  LocalPoints local;
  TileSorter sorter;
  DuplicateSample duplicates;
};

struct SortedBlocks {
  std::vector<BlockCounts> counts;
  double duplicates = 0;  ///< share of the points
};

SortedBlocks sort_blocks(const ScanReader& reader, const ScanFrame& frame, const UnitScale& scale,
                         const IngestParams& params, TileStore& store, const Advance& advance) {
  SortedBlocks blocks{std::vector<BlockCounts>(reader.blocks())};
  tbb::enumerable_thread_specific<Sorting> per_thread([&] {
    return Sorting{{}, TileSorter(frame, scale, params), {}};
  });
  for_blocks(reader, [&](std::size_t i, const ScanBlock& block) {
    Sorting& own = per_thread.local();
    to_local(block, frame, scale, own.local);
    own.duplicates.add(own.local);
    SortedBlock sorted;
    own.sorter.sort(own.local, sorted);
    blocks.counts[i] = {block.size() + block.no_returns, block.no_returns, own.local.not_finite,
                        own.local.far};
    store.put(i, std::move(sorted));
    if (advance) {
      advance(1);
    }
  });
  DuplicateSample duplicates;
  for (const Sorting& own : per_thread) {
    duplicates.add(own.duplicates);
  }
  blocks.duplicates = duplicates.share();
  return blocks;
}

void check_extent(const TiledScan& scan, std::uint64_t far, const ScanSettings& settings,
                  double tile_edge_m) {
  const IngestCounts& counts = scan.counts;
  const std::string hint = "check the unit (--unit m, cm, mm, ft) and the coordinates";
  if (static_cast<double>(far) >
      kLargestFarShare * static_cast<double>(counts.kept + counts.thin + counts.ghosts)) {
    throw StageError(errors::kScanExtent, settings.name,
                     std::to_string(far) + " of " + std::to_string(counts.read) +
                         " points lie kilometres from the others, taken as " + settings.unit,
                     hint);
  }
  if (counts.kept < kFewestPoints) {
    throw StageError(
        errors::kScanTooFewPoints, settings.name,
        "only " + std::to_string(counts.kept) + " usable points of " + std::to_string(counts.read),
        "a building needs thousands; " + hint);
  }
  std::array<std::uint32_t, 4> box{~0U, 0, ~0U, 0};
  for (const KeptTile& tile : scan.tiles) {
    const std::uint32_t ix = tile.tile % fixed_grid::kWindowTiles;
    const std::uint32_t iy = tile.tile / fixed_grid::kWindowTiles;
    box = {std::min(box[0], ix), std::max(box[1], ix), std::min(box[2], iy), std::max(box[3], iy)};
  }
  const double extent = std::max(box[1] - box[0], box[3] - box[2]) * tile_edge_m;
  if (extent > kLargest_m) {
    throw StageError(
        errors::kScanExtent, settings.name,
        "the points span " + std::to_string(std::lround(extent)) + " m, taken as " + settings.unit, hint);
  }
}

/// Later stages would find no level or no wall, and not know why.
void check_step(double step_m, const ScanSettings& settings) {
  if (step_m > kCoarsest_m) {
    throw StageError(errors::kScanTooCoarse, settings.name,
                     "the coordinates are rounded to steps of " + std::to_string(std::lround(1000 * step_m)) +
                         " mm, too coarse for a model; 32-bit numbers are so far from the origin",
                     "export the scan with 64-bit coordinates (double), or with an offset subtracted before");
  }
}

/// Few tiles may hold a scan that is tiny, because its unit is wrong.
void check_size(const TiledScan& scan, const ScanSettings& settings) {
  if (scan.tiles.size() > 4) {
    return;
  }
  std::array<float, 6> box{1e9F, -1e9F, 1e9F, -1e9F, 1e9F, -1e9F};
  for (const KeptTile& tile : scan.tiles) {
    scan.store->for_runs(tile.tile, [&](const TileRun& run) {
      const std::array<const float*, 3> axes{run.x, run.y, run.z};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax_element(axes[k], axes[k] + run.points);
        box[2 * k] = std::min(box[2 * k], *low);
        box[2 * k + 1] = std::max(box[2 * k + 1], *high);
      }
    });
  }
  const double extent = std::max({box[1] - box[0], box[3] - box[2], box[5] - box[4]});
  if (extent < kSmallest_m) {
    throw StageError(errors::kScanExtent, settings.name,
                     "the points span only " + std::to_string(extent) + " m, taken as " + settings.unit,
                     "check the unit (--unit m, cm, mm, ft) and the coordinates");
  }
}

}  // namespace

TiledScan tile_scan(const ScanReader& reader, const ScanSettings& settings, const IngestParams& params,
                    const Advance& advance) {
  const UnitScale scale(params.voxel_edge_m);
  TiledScan scan;
  scan.band_points = settings.band_points;
  {
    const ScanBlock sample = first_useful_block(reader);
    const double metres = metres_of(settings.unit);
    scan.middle =
        settings.middle ? *settings.middle : scan_middle(reader, sample, kReach_m / metres, advance);
    scan.frame = choose_frame(scan.middle, settings.unit, settings.up, settings.level);
    scan.step_m = quantisation_step(sample, scan.frame, reader);
    check_step(scan.step_m, settings);
  }
  scan.store = std::make_unique<TileStore>(settings.scratch_folder, reader.blocks(), settings.memory_bytes,
                                           reader.has_normals());
  const SortedBlocks blocks = sort_blocks(reader, scan.frame, scale, params, *scan.store, advance);
  IngestCounts& counts = scan.counts;
  std::uint64_t far = 0;
  for (const BlockCounts& block : blocks.counts) {
    counts.read += block.points;
    counts.no_returns += block.no_returns;
    counts.not_finite += block.not_finite;
    far += block.far;
  }
  reader.check_total(counts.read);
  const DroppedPoints dropped = reader.dropped();
  counts.no_returns += dropped.no_returns;
  counts.invalid = dropped.invalid;
  counts.read += dropped.no_returns + dropped.invalid;
  const std::uint64_t real = counts.read - counts.no_returns - counts.invalid - counts.not_finite;
  if (real == 0) {
    throw StageError(errors::kScanNoPoints, settings.name,
                     counts.read == 0 ? "there is not one point in it"
                                      : "none of its " + std::to_string(counts.read) +
                                            " points has finite coordinates other than 0 0 0",
                     "export the scan again");
  }
  const std::vector<CellCount> cells = scan.store->index_tiles();
  KeptCells kept = params.drop_ghosts ? without_ghosts(cells) : all_cells(cells);
  scan.tiles = std::move(kept.tiles);
  counts.thin = kept.thin.points;
  scan.thin_reach_m = kept.thin.cells * scale.tile_edge_m();
  for (const KeptTile& tile : scan.tiles) {
    counts.kept += tile.points;
  }
  counts.ghosts = real - counts.kept - counts.thin;
  check_extent(scan, far, settings, scale.tile_edge_m());
  check_size(scan, settings);
  if (blocks.duplicates > kManyDuplicates) {
    leave_out_duplicates(scan, params);
  }
  return scan;
}

}  // namespace roomcut::ingest

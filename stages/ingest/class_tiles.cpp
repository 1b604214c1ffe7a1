// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "stages/ingest/ingest.h"
#include "stages/ingest/large_tile.h"
#include "stages/ingest/surface_tile.h"
#include "stages/ingest/tile_place.h"

namespace roomcut::ingest {

namespace {

constexpr double kSmallestNoise_m = 1e-4;
constexpr double kUnknownNoise_m = 5e-3;
constexpr double kFewPlanes = 0.02;    // of all neighbourhoods: fewer may be chance
constexpr double kFarMore = 3;         // noise of one kind scatters by a fifth from place to place
constexpr double kTwoFaces_m = 0.025;  // scatter of both faces of a wall of 5 cm: more is no plane

/// A tile with all but its points, when they are many: those are handed over from the store.
struct FinishedTile {
  CloudTile cloud;
  std::unique_ptr<LargeTile> large;
  SurfaceEstimates estimates;
  bool refused = false;
};

/// Finished tiles to be used again: fresh memory for every tile would cost a tenth of the pass in page
/// faults.
class FinishedTiles {
 public:
  std::shared_ptr<FinishedTile> take() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) {
      return std::make_shared<FinishedTile>();
    }
    std::shared_ptr<FinishedTile> tile = std::move(free_.back());
    free_.pop_back();
    tile->estimates = {};
    tile->refused = false;
    tile->large.reset();
    return tile;
  }
  void give_back(const std::shared_ptr<FinishedTile>& tile) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(tile);
  }

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<FinishedTile>> free_;
};

/// What one thread needs to class tiles.
struct Workshop {
  explicit Workshop(const IngestParams& params) : finder(params) {}
  TilePoints loaded;
  TileRuns runs;
  TileGrid grid;
  SurfaceFinder finder;
};

void class_tile(const TiledScan& scan, const KeptTile& tile, const UnitScale& scale, Workshop& workshop,
                FinishedTile& finished) {
  scan.store->gather(tile.tile, workshop.loaded, workshop.runs);
  workshop.grid.build(workshop.runs, place_of(scan, tile), scale);
  const std::vector<VoxelSurface>& surfaces = workshop.finder.find(workshop.grid, scale, finished.estimates);
  const bool normals = scan.store->has_hints();
  if (normals) {
    NormalsCheck check;
    check.add(workshop.grid, surfaces);
    finished.refused = check.refused();
  }
  make_cloud_part(workshop.grid, surfaces, normals && !finished.refused, finished.cloud);
}

void class_large_tile(const TiledScan& scan, const KeptTile& tile, const UnitScale& scale,
                      const IngestParams& params, FinishedTile& finished) {
  finished.large = std::make_unique<LargeTile>(*scan.store, tile.tile, place_of(scan, tile), scale, params,
                                               scan.band_points);
  finished.refused = finished.large->find_surfaces(finished.estimates);
}

}  // namespace

CloudHeader header_of(const TiledScan& scan, const std::vector<Vec3>& stations, const std::string& crs,
                      const IngestParams& params) {
  const UnitScale scale(params.voxel_edge_m);
  CloudHeader header;
  header.frame = scan.frame.frame;
  header.frame.crs = crs;
  header.points = scan.counts.kept;
  header.tile_edge_m = scale.tile_edge_m();
  header.voxel_edge_m = params.voxel_edge_m;
  header.tile_offset.push_back(0);
  for (const KeptTile& tile : scan.tiles) {
    header.tile_ix.push_back(static_cast<std::int32_t>(tile.tile % fixed_grid::kWindowTiles) +
                             scan.frame.window[0]);
    header.tile_iy.push_back(static_cast<std::int32_t>(tile.tile / fixed_grid::kWindowTiles) +
                             scan.frame.window[1]);
    header.tile_offset.push_back(header.tile_offset.back() + tile.points);
  }
  for (const Vec3& station : stations) {
    header.stations.push_back(scan.frame.local(station));
  }
  return header;
}

SurfaceSummary class_tiles(const TiledScan& scan, const IngestParams& params, const TakePart& take,
                           const Advance& advance) {
  const UnitScale scale(params.voxel_edge_m);
  tbb::enumerable_thread_specific<Workshop> workshops([&] { return Workshop(params); });
  FinishedTiles tiles;
  SurfaceSummary summary;
  std::size_t next = 0;
  const auto tokens = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + 1;
  const auto next_tile = [&](tbb::flow_control& flow) {
    if (next == scan.tiles.size()) {
      flow.stop();
      return std::size_t{0};
    }
    return next++;
  };
  const auto class_one = [&](std::size_t index) {
    std::shared_ptr<FinishedTile> finished = tiles.take();
    const KeptTile& tile = scan.tiles[index];
    if (is_large(scan, tile)) {
      class_large_tile(scan, tile, scale, params, *finished);
    } else {
      class_tile(scan, tile, scale, workshops.local(), *finished);
    }
    return finished;
  };
  const auto hand_over = [&](const std::shared_ptr<FinishedTile>& tile) {
    summary.estimates.add(tile->estimates);
    summary.tiles_with_refused_normals += tile->refused ? 1 : 0;
    const auto take_part = [&](const CloudTile& part, bool last) {
      take(part, last);
      if (advance) {
        advance(part.size());
      }
    };
    if (tile->large) {
      tile->large->hand_over(take_part);
      tile->large.reset();
    } else {
      take_part(tile->cloud, true);
    }
    tiles.give_back(tile);
  };
  using Tile = std::shared_ptr<FinishedTile>;
  constexpr auto kInOrder = tbb::filter_mode::serial_in_order;
  tbb::parallel_pipeline(tokens,
                         tbb::make_filter<void, std::size_t>(kInOrder, next_tile) &
                             tbb::make_filter<std::size_t, Tile>(tbb::filter_mode::parallel, class_one) &
                             tbb::make_filter<Tile, void>(kInOrder, hand_over));
  return summary;
}

double noise_of(const SurfaceEstimates& estimates, double step_m) {
  const double lowest = std::max(kSmallestNoise_m, step_m / std::sqrt(12.0));
  if (estimates.noise.total() == 0) {
    return std::max(lowest, kUnknownNoise_m);
  }
  const LogHistogram planes = estimates.noise.below(kTwoFaces_m);
  const double all = estimates.noise.median();
  // Few clear planes: it is noise like theirs, unless in sparse scans nearly all neighbourhoods hold both
  // faces of a wall, which scatter far more than the others.
  const bool enough = 4 * planes.total() >= estimates.noise.total();
  const bool other =
      kFewPlanes * static_cast<double>(estimates.noise.total()) <= static_cast<double>(planes.total()) &&
      kFarMore * planes.median() < all;
  return std::max(lowest, enough || other ? planes.median() : all);
}

double density_of(const SurfaceEstimates& estimates) {
  const double area = estimates.area.median();
  return area > 0 ? 1 / area : 0;
}

}  // namespace roomcut::ingest

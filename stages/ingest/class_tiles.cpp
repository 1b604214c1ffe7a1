// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>

#include "stages/ingest/ingest.h"
#include "stages/ingest/surface_tile.h"

namespace roomcut {

namespace {

constexpr double kSmallestNoise_m = 1e-4;
constexpr double kUnknownNoise_m = 5e-3;
constexpr double kTwoFaces_m = 0.025;  // scatter of both faces of a wall of 5 cm: more is no plane
constexpr std::uint64_t kMostInWork = 16'000'000;  // points of all tiles in work; each takes some 50 bytes
constexpr std::uint64_t kLargeTile = 4'000'000;    // points of a tile whose memory is not kept for the next

struct FinishedTile {
  CloudTile cloud;
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
    return tile;
  }
  void give_back(const std::shared_ptr<FinishedTile>& tile) {
    if (tile->cloud.size() < kLargeTile) {
      const std::scoped_lock lock(mutex_);
      free_.push_back(tile);
    }
  }

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<FinishedTile>> free_;
};

/// Lets tiles in, in their order, as long as there is room for their points, and one in any case: the tiles
/// of a very dense scan are worked on one after the other. The first tile inside can always go on, so none
/// waits for ever.
class TilesInWork {
 public:
  void enter(std::uint64_t points) {
    std::unique_lock lock(mutex_);
    left_.wait(lock, [&] { return points_ == 0 || points_ + points <= kMostInWork; });
    points_ += points;
  }
  void leave(std::uint64_t points) {
    const std::scoped_lock lock(mutex_);
    points_ -= points;
    left_.notify_one();
  }
  /// Leaves at the end of its scope, however that ends.
  class Exit {
   public:
    Exit(TilesInWork& tiles, std::uint64_t points) : tiles_(tiles), points_(points) {}
    ~Exit() { tiles_.leave(points_); }
    Exit(const Exit&) = delete;
    Exit& operator=(const Exit&) = delete;

   private:
    TilesInWork& tiles_;
    std::uint64_t points_;
  };

 private:
  std::mutex mutex_;
  std::condition_variable left_;
  std::uint64_t points_ = 0;
};

/// What one thread needs to class tiles.
struct Workshop {
  explicit Workshop(const IngestParams& params) : finder(params) {}
  TilePoints points;
  TileGrid grid;
  SurfaceFinder finder;
};

std::uint64_t layers_of(const std::vector<KeptTile>& tiles, std::uint32_t tile) {
  const auto found =
      std::lower_bound(tiles.begin(), tiles.end(), tile,
                       [](const KeptTile& kept, std::uint32_t wanted) { return kept.tile < wanted; });
  return found != tiles.end() && found->tile == tile ? found->layers : 0;
}

TilePlace place_of(const TiledScan& scan, const KeptTile& tile) {
  constexpr int kTiles = fixed_grid::kWindowTiles;
  const int column = static_cast<int>(tile.tile % kTiles);
  const int row = static_cast<int>(tile.tile / kTiles);
  TilePlace place{column + scan.frame.window[0], row + scan.frame.window[1], scan.frame.window[2], {}};
  for (int k = 0; k < 9; ++k) {
    const int other_column = column + k % 3 - 1;
    const int other_row = row + k / 3 - 1;
    const bool inside = other_column >= 0 && other_row >= 0 && other_column < kTiles && other_row < kTiles;
    place.layers[static_cast<std::size_t>(k)] =
        inside ? layers_of(scan.tiles, static_cast<std::uint32_t>(other_row * kTiles + other_column)) : 0;
  }
  return place;
}

void class_tile(const TiledScan& scan, const KeptTile& tile, const UnitScale& scale, Workshop& workshop,
                FinishedTile& finished) {
  scan.store->gather(tile.tile, workshop.points);
  workshop.grid.build(workshop.points, place_of(scan, tile), scale);
  const std::vector<VoxelSurface>& surfaces = workshop.finder.find(workshop.grid, scale, finished.estimates);
  finished.refused = make_cloud_tile(workshop.grid, surfaces, scan.store->has_hints(), finished.cloud);
}

}  // namespace

CloudHeader header_of(const TiledScan& scan, const std::vector<Vec3>& stations, const IngestParams& params) {
  const UnitScale scale(params.voxel_edge_m);
  CloudHeader header;
  header.frame = scan.frame.frame;
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

SurfaceSummary class_tiles(const TiledScan& scan, const IngestParams& params,
                           const std::function<void(const CloudTile&)>& take, const Advance& advance) {
  const UnitScale scale(params.voxel_edge_m);
  tbb::enumerable_thread_specific<Workshop> workshops([&] { return Workshop(params); });
  FinishedTiles tiles;
  TilesInWork in_work;
  SurfaceSummary summary;
  std::size_t next = 0;
  const auto tokens = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + 1;
  const auto next_tile = [&](tbb::flow_control& flow) {
    if (next == scan.tiles.size()) {
      flow.stop();
      return std::size_t{0};
    }
    in_work.enter(scan.tiles[next].points);
    return next++;
  };
  const auto class_one = [&](std::size_t tile) {
    std::shared_ptr<FinishedTile> finished = tiles.take();
    Workshop& workshop = workshops.local();
    try {
      class_tile(scan, scan.tiles[tile], scale, workshop, *finished);
    } catch (...) {
      in_work.leave(scan.tiles[tile].points);  // or the next one would wait for ever
      throw;
    }
    if (scan.tiles[tile].points >= kLargeTile) {
      workshop = Workshop(params);
    }
    return finished;
  };
  const auto hand_over = [&](const std::shared_ptr<FinishedTile>& tile) {
    summary.estimates.add(tile->estimates);
    summary.tiles_with_refused_normals += tile->refused ? 1 : 0;
    const TilesInWork::Exit exit(in_work, tile->cloud.size());
    take(tile->cloud);
    if (advance) {
      advance(tile->cloud.size());
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
  const bool enough = 4 * planes.total() >= estimates.noise.total();
  return std::max(lowest, enough ? planes.median() : estimates.noise.median());
}

double density_of(const SurfaceEstimates& estimates) {
  const double area = estimates.area.median();
  return area > 0 ? 1 / area : 0;
}

}  // namespace roomcut

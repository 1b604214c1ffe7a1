// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "stages/ingest/ghosts.h"
#include "stages/ingest/params.h"
#include "stages/ingest/scan_frame.h"
#include "stages/ingest/scratch_file.h"

namespace roomcut::ingest {

/// The points of one tile and of the halo around it, in file order.
struct TilePoints {
  std::vector<float> x, y, z;
  std::vector<std::uint16_t>
      hint;  ///< class and azimuth from the file's normals (normal_hint.h); empty without normals
  std::size_t size() const { return x.size(); }
  void resize(std::size_t points, bool hints) {
    for (std::vector<float>* axis : {&x, &y, &z}) {
      axis->resize(points);
    }
    hint.resize(hints ? points : 0);
  }
};

/// Points of a tile or its halo that lie together in the store; `hint` null without normals.
struct TileRun {
  const float *x, *y, *z;
  const std::uint16_t* hint;
  std::size_t points;
};

/// All points of a tile and its halo, run after run.
using TileRuns = std::vector<TileRun>;

/// Height of the lowest point [m].
inline float lowest_of(const TileRuns& runs) {
  float lowest = std::numeric_limits<float>::max();
  for (const TileRun& run : runs) {
    lowest = std::min(lowest, *std::min_element(run.z, run.z + run.points));
  }
  return lowest;
}

inline TileRun run_of(const TilePoints& points) {
  return {points.x.data(), points.y.data(), points.z.data(),
          points.hint.empty() ? nullptr : points.hint.data(), points.size()};
}

/// Points of one block sorted by tile: the unit that is held in memory or written to the scratch file.
class SortedBlock {
 public:
  struct Run {
    std::uint32_t tile = 0;  ///< row-major index in the window
    std::uint32_t points = 0;
    std::uint64_t offset = 0;  ///< of the run's first byte in the block
  };
  std::vector<Run> runs;
  std::vector<CellCount> cells;  ///< points per tile and layer, halo not counted
  std::unique_ptr<std::byte[]> bytes;
  std::uint64_t size = 0;
  std::uint64_t file_offset = 0;  ///< in the scratch file, once `bytes` is empty
};

/// Sorts blocks of points by tile. One per thread. Each run holds x[n], y[n], z[n] and, with normals,
/// hint[n].
class TileSorter {
 public:
  TileSorter(const ScanFrame& frame, const UnitScale& scale, const IngestParams& params);
  /// Takes the points of `local` apart into tiles and halos, keeping their order.
  void sort(const LocalPoints& local, SortedBlock& block);

 private:
  struct Place {  ///< where a point goes: a slot, and the tiles beside it whose halo it lies in
    std::uint32_t slot;
    std::int8_t beside_x, beside_y;
  };
  struct Slot {
    std::uint32_t tile;
    std::uint32_t points;
    std::array<std::uint32_t, fixed_grid::kWindowLayers> layers;
  };
  struct Cursor {
    float* x;  // y and z lie `points` and 2 `points` behind: one pointer to move per point, not three
    std::size_t points;  // of the run
    std::uint16_t* hint;
  };
  std::uint32_t slot_of(std::uint32_t tile);
  template <class Visit>
  void for_halos(const Place& place, Visit&& visit);
  void place_points(const LocalPoints& local);
  void lay_out(bool hints, SortedBlock& block);
  void scatter(const LocalPoints& local);
  void clear();

  const ScanFrame& frame_;
  const UnitScale& scale_;
  const IngestParams& params_;
  /// Slot + 1 by row and column of the tiles, 0 = not seen in this block; a row has memory once it was seen.
  std::vector<std::vector<std::uint32_t>> slot_of_tile_;
  std::vector<Slot> slots_;
  std::vector<Place> places_;
  std::vector<Cursor> cursors_;
};

/// All points between the two passes: in memory up to a budget, beyond it in a scratch file that has no name
/// any more.
class TileStore {
 public:
  /// The scratch file is made in `folder` when it is needed.
  TileStore(std::filesystem::path folder, std::size_t blocks, std::uint64_t memory_bytes, bool hints);

  /// Takes over block `index`. Thread-safe for different blocks. Errors: kCannotWrite.
  void put(std::size_t index, SortedBlock&& block);
  /// To be called once after the last put(): sorts the runs by tile. Returns the points per cell of the
  /// window.
  std::vector<CellCount> index_tiles();
  using VisitRun = std::function<void(const TileRun&)>;
  /// Calls visit(run) for the points of a tile and its halo, in file order. Thread-safe, like gather().
  void for_runs(std::uint32_t tile, const VisitRun& visit) const;
  /// All of them: where they lie, or read from the scratch file into `loaded`.
  void gather(std::uint32_t tile, TilePoints& loaded, TileRuns& runs) const;
  const std::filesystem::path& scratch_folder() const { return scratch_.folder(); }
  bool has_hints() const { return hints_; }
  std::uint64_t spilled_bytes() const { return file_end_; }

 private:
  struct RunRef {
    std::uint32_t tile;
    std::uint32_t block;
    std::uint32_t points;
    std::uint64_t offset;
  };
  std::vector<RunRef>::const_iterator first_run(std::uint32_t tile) const;

  std::vector<SortedBlock> blocks_;
  std::vector<RunRef> runs_;
  std::uint64_t budget_;
  std::atomic<std::uint64_t> held_{0};
  std::atomic<std::uint64_t> file_end_{0};
  ScratchFile scratch_;
  bool hints_;
};

}  // namespace roomcut::ingest

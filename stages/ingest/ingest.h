// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/cloud/cloud.h"
#include "stages/ingest/estimates.h"
#include "stages/ingest/params.h"
#include "stages/ingest/scan_reader.h"
#include "stages/ingest/tile_store.h"

namespace roomcut::ingest {

/// Where the points went.
struct IngestCounts {
  std::uint64_t read = 0;
  std::uint64_t no_returns = 0;  ///< dropped: exactly 0 0 0, a beam that met nothing
  std::uint64_t invalid = 0;     ///< dropped: marked as invalid or withheld in the file
  std::uint64_t not_finite = 0;  ///< dropped: NaN or infinite
  std::uint64_t thin = 0;        ///< dropped: behind the rest, too few to show a wall
  std::uint64_t ghosts = 0;      ///< dropped: far from the building, in sparse cells
  std::uint64_t duplicates = 0;  ///< dropped: with the coordinates of another one, when there are many such
  std::uint64_t kept = 0;
};

/// What the user says about a scan.
struct ScanSettings {
  std::string unit = "m";
  std::string up = "z";
  std::array<double, 3> level{0, 0,
                              1};  ///< up in the scan's axes, after `up`: it is turned so that this is z
  std::optional<Vec3> middle;      ///< scan_middle(), when it is known already
  std::uint64_t memory_bytes = std::uint64_t{256} << 20;  ///< points held in memory between the passes
  std::filesystem::path scratch_folder;                   ///< for points beyond the memory budget
  std::string name;                                       ///< of the scan, for messages
  std::uint64_t band_points =
      500'000;  ///< of a tile with more than four times as many, so many are held at a time
};

using Advance = std::function<void(std::uint64_t)>;

/// The scan after the first pass: its points sorted by tile.
struct TiledScan {
  ScanFrame frame;
  Vec3 middle;  ///< scan_middle()
  std::unique_ptr<TileStore> store;
  std::vector<KeptTile> tiles;  ///< by (iy, ix)
  IngestCounts counts;
  double thin_reach_m = 0;        ///< how far the scan goes on behind what is kept, in points counted as thin
  double step_m = 0;              ///< quantisation of the coordinates
  std::uint64_t band_points = 0;  ///< as in ScanSettings
  bool distinct = false;          ///< points in `store` that repeat another one's coordinates are left out
};

/// First pass: reads every block in parallel, once for the scan's middle and once more to sort its points
/// into tiles. `advance(1)` is called per block and reading. Errors: those of the reader (of the first faulty
/// block), kScanNoPoints, kScanTooFewPoints, kScanExtent, kScanTooCoarse, kCannotWrite. The result does not
/// depend on the number of threads.
TiledScan tile_scan(const ScanReader& reader, const ScanSettings& settings, const IngestParams& params,
                    const Advance& advance = {});

/// The cloud's header as far as the first pass knows it; noise, density and box are left at 0.
CloudHeader header_of(const TiledScan& scan, const std::vector<Vec3>& stations, const std::string& crs,
                      const IngestParams& params);

/// What the second pass finds out on its way.
struct SurfaceSummary {
  SurfaceEstimates estimates;
  std::uint64_t tiles_with_refused_normals = 0;
};

/// Receives the points of a tile, those of one with many points in several parts; true: the last of its tile.
using TakePart = std::function<void(const CloudTile&, bool)>;

/// Second pass: classes the points tile by tile, in parallel, and gives the tiles to `take` one after another
/// in order. `advance(points)` is called per part. Memory: a few tiles of band_points each.
SurfaceSummary class_tiles(const TiledScan& scan, const IngestParams& params, const TakePart& take,
                           const Advance& advance = {});

/// Noise [m]: the median over the clear planes that scatter less than the two faces of a thin wall would, but
/// not below what rounded coordinates or 0.1 mm allow. When those are fewer than a quarter, over all planes,
/// unless these scatter three times as much: then they are both faces of walls in a sparse scan; 5 mm when no
/// voxel was a clear plane.
double noise_of(const SurfaceEstimates& estimates, double step_m);
/// Points per square metre; 0 without points.
double density_of(const SurfaceEstimates& estimates);

}  // namespace roomcut::ingest

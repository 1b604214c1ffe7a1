// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/cloud/cloud.h"
#include "common/robust/robust_offset.h"
#include "stages/refine_lines/line_faces.h"
#include "stages/refine_lines/line_neighbourhood.h"

namespace roomcut::refine_lines {

/// Where a wall's surface lies in one patch: a piece of a line, a piece of height.
struct Observation {
  Vec2 point;          ///< in plan [m]
  double variance_m2;  ///< of its distance from the line, expected from noise and number of points
  double scatter_m2;   ///< mean square distance of its points from it
  std::uint32_t points;
  int zone;               ///< piece of height, from below
  std::size_t bin = 0;    ///< of the line's raster
  std::size_t layer = 0;  ///< of the line's raster
};

/// Bins of a patch's histogram of offsets from its line (common/robust).
inline constexpr int kOffsetBins = 50;

/// Collects, in one pass over the points and in any order, the observations of all lines. A point counts for
/// one line only: the nearest one that carries surface at its height and place and whose azimuth fits within
/// 17 degrees. Points on no plane count too, away from floors and ceilings: beside a thin wall the
/// neighbourhood of a point reaches through to the other face, more so for points on the inner side, so
/// planes alone would push the two faces apart. Patches are as long as the line's raster and about 50 cm
/// high, higher where points are sparse (about 20 a patch), and never reach over a level: a wall that leans,
/// furniture that hides its lower part, and another storey's wall show as patches that differ, not as a
/// smeared histogram. Memory: 8 kB per square metre of surface. Deterministic for any number of threads:
/// integer sums.
class LineObserver {
 public:
  /// `active[i]`: whether lines[i] takes part. `levels` as in CellComplex; lines, levels stay owned by the
  /// caller.
  LineObserver(const std::vector<LineFaces>& lines, const std::vector<bool>& active,
               const std::vector<double>& levels, double band_m, double noise_m, double density);

  /// Adds the points of a tile that are on no horizontal surface. Thread-safe.
  void add(const CloudTile& tile);

  /// Observations of line i, zone by zone from below, ascending along the line; patches with fewer than 4
  /// points are left out.
  std::vector<Observation> observations(std::size_t i) const;
  std::uint64_t points() const { return points_.load(); }

 private:
  struct Hit;
  LineTrack make_track(std::size_t line, std::int32_t& patches) const;
  std::size_t zone_of(double z, std::size_t layer) const;
  Hit find_line(const CloudTile& tile, std::size_t i, std::span<const NearLine> near) const;

  const std::vector<LineFaces>& lines_;
  const std::vector<double>& levels_;
  double band_m_, noise_m_;
  std::vector<std::size_t> first_zone_;  ///< per layer, and one behind the last
  std::size_t zones_ = 1;
  std::vector<LineTrack> tracks_;
  std::vector<NearLine> all_lines_;    ///< of the tracks
  std::vector<std::size_t> track_of_;  ///< per line, tracks_.size() when inactive
  std::unique_ptr<std::atomic<std::uint64_t>[]> histograms_;
  std::unique_ptr<std::atomic<std::int64_t>[]>
      along_;  ///< per patch: sum of micrometres from the bin's start
  std::atomic<std::uint64_t> points_{0};
};

}  // namespace roomcut::refine_lines

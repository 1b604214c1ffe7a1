// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/cloud/cloud.h"
#include "stages/find_openings/room_walls.h"

namespace roomcut::find_openings {

/// The evidence on one wall: rasters over (t along face a, z). Rows are row_m high and start at z0.
struct WallRasters {
  static constexpr std::size_t kFine = 5;  ///< bins per column of RoomWall
  double z0 = 0, row_m = 0, bin_m = 0;     ///< bins are bin_m long, in t and in z
  std::size_t columns = 0, rows = 0, z_bins = 0;
  std::vector<std::uint32_t> face_a, face_b;  ///< points on the faces: columns × rows
  std::vector<std::uint64_t> jambs;  ///< BinSum of the points between the faces: (columns · kFine) × rows
  std::vector<std::uint64_t> heads;  ///< the same, binned in z: columns × z_bins
};

struct EvidenceSettings {
  double margin_m = 0;  ///< a point within it of a face is on that face, at most a third of the wall
  double row_m = 0.1;   ///< height of a row
};

/// Collects the rasters of all walls in one pass over the points, in any order and by any number of threads:
/// integer sums. Every point counts, whatever its class: beside an edge the planes are not to be trusted.
/// Memory: about 20 kB per square metre of wall, none per point.
class WallEvidence {
 public:
  /// `walls` and `levels` stay the caller's.
  WallEvidence(const std::vector<RoomWall>& walls, const std::vector<double>& levels,
               const EvidenceSettings& settings);
  ~WallEvidence();

  void add(const CloudTile& tile);  ///< thread-safe
  WallRasters rasters(std::size_t wall) const;
  std::uint64_t points() const { return points_.load(); }

 private:
  struct Sums;
  struct Near;
  bool meets(const Sums& sums, const Vec2& low, const Vec2& high) const;
  Near walls_near(const CloudTile& tile) const;
  void add_point(const Sums& sums, const Vec2& p, double z) const;

  std::vector<std::unique_ptr<Sums>> sums_;
  double margin_m_;
  std::atomic<std::uint64_t> points_{0};
};

}  // namespace roomcut::find_openings

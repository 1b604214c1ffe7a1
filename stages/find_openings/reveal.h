// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "common/openings/opening.h"
#include "stages/find_openings/room_walls.h"
#include "stages/find_openings/wall_evidence.h"

namespace roomcut::find_openings {

/// Tolerances that follow from the scan.
struct OpeningTolerances {
  double margin_m = 0;  ///< points this near a face lie on it
  double row_m = 0;     ///< rows of evidence: high enough for some 3 points per 15 cm of wall, 10 … 50 cm
  double noise_m = 0;
  /// Half width of the window in which points are taken for one surface [m].
  double window_m() const { return std::max(0.015, 2.5 * noise_m); }
};

/// A stretch of wall over one floor: columns [first, last).
struct Stretch {
  std::size_t first = 0, last = 0;
  double floor_z = 0;
  double top_z = 0;  ///< the lowest of the columns' tops
};

/// A jamb at t = at, or a head at z = at [m], and the points that prove it.
struct RevealSurface {
  double at = 0;
  OpeningProof proof;
};

/// Shares of a rectangle's raster cells, 0 … 1.
struct Cover {
  double face_a = 0, face_b = 0;  ///< with points on the face
  double inside = 0;              ///< with points between the faces
  double either() const { return std::max(face_a, face_b); }
};

/// Reads the surfaces of openings, and what is around them, from the rasters of one wall.
class Reveal {
 public:
  Reveal(const RoomWall& wall, const WallRasters& rasters, const OpeningTolerances& tolerances)
      : wall_(wall), r_(rasters), tolerances_(tolerances) {}

  /// Cover of t0 … t1, z0 … z1: whole columns and rows only. None when there is not one of them.
  std::optional<Cover> cover(double t0, double t1, double z0, double z1) const;

  /// Upright surfaces across the wall, ascending: peaks along it of the points between the faces, from z0 to
  /// z1. A peak has at least 8 points, on 45 % of the rows; the strongest within 6 cm counts.
  std::vector<RevealSurface> find_jambs(const Stretch& stretch, double z0, double z1) const;

  /// The lowest level surface inside the wall between z0 and z1 that has points on half of the width t0 … t1,
  /// at least 8, and half as many as the strongest.
  std::optional<RevealSurface> find_head(double t0, double t1, double z0, double z1) const;

 private:
  using Range = std::pair<std::size_t, std::size_t>;  // [first, last)
  Range columns_within(double t0, double t1) const;
  Range rows_within(double z0, double z1) const;
  std::size_t window_bins() const;
  double cut_bins() const;
  double row_spread(std::size_t bin, const Range& bins, const Range& rows) const;
  double column_spread(std::size_t bin, const Range& columns) const;

  const RoomWall& wall_;
  const WallRasters& r_;
  const OpeningTolerances& tolerances_;
};

}  // namespace roomcut::find_openings

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/slices/slices.h"

namespace roomcut::detect_lines {

/// Occupied cells of all wall slices in one list (slice by slice, as in Slices), with the direction of the
/// wall there.
struct WallCells {
  std::vector<float> x, y;             ///< centroid [m]
  std::vector<float> weight_m;         ///< length of wall the cell speaks for
  std::vector<float> area_m2;          ///< surface of its points: weight in a fit
  std::vector<float> coverage;         ///< share of the height of its slice's evidence that is occupied
  std::vector<float> theta;            ///< direction of the normal, [0, pi) [rad]; 0 for clutter
  std::vector<float> offset_m;         ///< of the neighbourhood's mean from the centroid, along the normal
  std::vector<std::uint8_t> boundary;  ///< 1 = piece of a wall, 0 = clutter
  std::vector<std::int32_t> slice;
  std::vector<std::int32_t> line;  ///< index of the detected line that took it; -1 = none
  std::size_t size() const { return x.size(); }
};

/// Tells walls from clutter (paper §2): the centroids within 2 tau are a piece of wall when lambda2 / lambda1
/// of their weighted covariance is below `linearity`; with `wider`, where noise or corners hide that, 4 tau
/// and 8 tau are tried, and last the azimuth that the wall points' own normals agree on. Parallel over rows;
/// the result does not depend on threads.
WallCells classify_cells(const Slices& slices, double linearity, bool wider = true);

}  // namespace roomcut::detect_lines

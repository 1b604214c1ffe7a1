// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/slices/slices.h"
#include "stages/slice/tile_source.h"

namespace roomcut::slice {

/// Where wall evidence is looked for between two neighbouring levels.
struct EvidenceRange {
  double lo = 0, hi = 0;      ///< heights of the points that count [m]
  double slice_m = 0;         ///< height of the whole wall slice [m]
  int bins = 0;               ///< equal height bins of about 12 cm, at most 64; 0 = too thin to hold evidence
  double contour_z = 0;       ///< sloped points this high count as wall; NaN = none do [m]
  double contour_half_m = 0;  ///< half the thickness of that contour [m]
  double bin_m() const { return (hi - lo) / bins; }
};

/// The ranges of all wall slices: between the bands of the levels; of slices higher than `tall_slice_m` only
/// the top `evidence_share`, where furniture does not reach. Under a cap no ceiling was seen, so the whole
/// slice counts. Between two steps of a slope the contour at half height, twice `contour_half_m` thick,
/// counts as wall: there the stairs rise that stand for the slope. Not at heights that planes pass: there
/// they say where the stairs rise.
std::vector<EvidenceRange> evidence_ranges(const std::vector<Level>& levels, double tall_slice_m,
                                           double evidence_share, const std::vector<SlopedPlane>& planes = {},
                                           double contour_half_m = 0.02);

/// Occupancy of the wall slices (paper §2: down-sampling by an occupancy map of edge tau), one pass over the
/// points. Wall points and points without a plane count, horizontal ones do not, sloped ones on
/// the contours only; without `upright_only` all count. Coverage is the
/// share of occupied height bins over the share to be expected on a closed wall at the cell's density.
/// Integer sums: order-free. Memory: the occupied cells, nothing dense.
std::vector<OccupancyGrid> occupy_wall_slices(const TileSource& tiles,
                                              const std::vector<EvidenceRange>& ranges, double tau_m,
                                              bool upright_only = true);

}  // namespace roomcut::slice

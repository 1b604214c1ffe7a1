// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/artefact/provenance.h"
#include "common/geometry/line2.h"
#include "common/geometry/sloped_plane.h"

namespace roomcut {

/// A peak of the vertical histogram: the height of floors and ceilings (paper §2, horizontal slicing).
struct Level {
  double z = 0;             ///< weighted mean height of the band [m]
  double lo = 0, hi = 0;    ///< the horizontal structure slice around it [m]
  double area_m2 = 0;       ///< area of horizontal surface in the band
  double component_m2 = 0;  ///< its largest connected component
  bool cap = false;         ///< not a peak: closes the building where walls go on past the last peak
  bool step = false;        ///< not a peak: one of several that stand for a slope, as stairs would
};

/// Area of horizontal surface per height bin.
struct VerticalHistogram {
  double z0 = 0;  ///< lower edge of bin 0 [m]
  double bin_m = 0;
  std::vector<double> area_m2;
};

/// The wall evidence of one wall slice (the space between two neighbouring levels): occupied cells of a
/// square grid.
struct OccupancyGrid {
  std::vector<std::int32_t> ix, iy;  ///< cell indices: floor(x / tau), floor(y / tau); sorted by (iy, ix)
  std::vector<float> x, y;           ///< centroid of the cell's points [m]
  std::vector<float> coverage;  ///< share of the slice's height that is occupied, density-corrected, 0 … 1
  std::vector<float>
      weight_m;  ///< length of wall for which the cell counts: coverage × tau × min(1, height / 0.25 m) [m]
  std::vector<float> area_m2;         ///< surface that the cell's points stand for: its weight in a fit [m^2]
  std::vector<std::uint8_t> azimuth;  ///< mean azimuth of the wall points, in the steps of common/cloud
  std::vector<std::uint8_t> azimuth_trust;  ///< 0 = no wall points, 255 = all agree
  std::size_t size() const { return ix.size(); }
};

struct Slices {
  Frame frame;
  Vec3 bbox_min{0, 0, 0}, bbox_max{0, 0, 0};  ///< [m], local
  double noise_m = 0;
  double density = 0;  ///< [1/m^2]
  double tau_m = 0;    ///< edge of the occupancy cells (paper: grid-size tau)
  double step_m = 0;   ///< distance of the steps that stand for slopes; 0 = there are none
  VerticalHistogram histogram;
  std::vector<Level> levels;               ///< ascending, at least 2
  std::vector<OccupancyGrid> wall_slices;  ///< levels.size() - 1: slice k lies between levels k and k+1
  std::vector<SlopedPlane> planes;         ///< sloped floors and ceilings, largest first
};

}  // namespace roomcut

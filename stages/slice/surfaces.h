// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stages/slice/survey.h"

namespace roomcut::slice {

/// One surface in one plan cell: neighbouring patches of a column joined.
struct SurfaceCell {
  std::int32_t ix = 0, iy = 0;
  std::int32_t count = 0;
  double z = 0;      ///< mean height [m]
  double rms_m = 0;  ///< spread of its points about it [m]
  double area_m2 = 0;
  double drift_m = 0;  ///< how far the surface it belongs to wanders up and down (standard deviation) [m]
};

/// Joins patches of a column that are closer than max(2.5 cm, 3 noise). Sorted by (iy, ix, z).
std::vector<SurfaceCell> surface_cells(const std::vector<SurfacePatch>& patches, double noise_m);

/// Finds the surfaces that run smoothly from cell to cell and sets each cell's drift_m: 0 for a level
/// surface, the standard deviation of its height in blocks of 1 m where it tilts or drifts. A drifting floor
/// of a mobile scan is one surface, whatever its range of heights, while two ceilings 4 cm apart are two: no
/// smooth way leads across the step. Scraps take the drift of the surface they lie on.
void measure_drift(std::vector<SurfaceCell>& cells, double raster_m, double noise_m);

/// A connected part of the cells within a band of heights.
struct SurfaceComponent {
  double area_m2 = 0;
  std::vector<SurfaceCell> cells;  ///< one per column, sorted by (iy, ix)
};

/// Components of the cells with lo <= z <= hi, largest first. Cells are connected when they lie side by side
/// or, where points are sparse, within 2.5 point spacings. `cells` must be sorted by (iy, ix, z).
std::vector<SurfaceComponent> components(const std::vector<SurfaceCell>& cells, double lo, double hi,
                                         double raster_m);

}  // namespace roomcut::slice

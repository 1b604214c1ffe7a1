// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "stages/detect_lines/circle_fit.h"

namespace roomcut::detect_lines {

/// The cells of one stretch of a curved wall, together.
struct ArcBin {
  double at = 0;  ///< middle, along the circle [m]
  Vec2 mean{0, 0};
  double distance_m = 0;  ///< mean of the cells' distances from the circle
  double weight = 0;      ///< area of its cells [m^2]
  CellIndices cells;
};

/// The bins but those far off the circle, a tenth of them at most: something stands before the wall there.
std::vector<ArcBin> without_outliers(std::vector<ArcBin> bins);

/// Whether Schwarz's criterion prefers the circle to the best polyline through the bins: `least_gain` is by
/// how much, in its own unit; `floor_m` is what the means of bins scatter by at least. Polylines of up to as
/// many sides as there are bins for, three each.
bool circle_beats_polyline(const std::vector<ArcBin>& bins, double floor_m, double least_gain);

}  // namespace roomcut::detect_lines

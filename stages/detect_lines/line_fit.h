// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/line2.h"
#include "stages/detect_lines/wall_cells.h"

namespace roomcut::detect_lines {

using CellIndices = std::vector<std::uint32_t>;  ///< into WallCells, ascending

struct FitRules {
  double inlier_m = 0;          ///< farthest distance of an inlier
  double inlier_angle_rad = 0;  ///< farthest angle of an inlier
  double cauchy_m = 0;          ///< scale of the Cauchy weights
  double bin_m = 0;             ///< bins along the line in which support is counted
  double max_gap_m = 0;         ///< longest gap within one support
};

/// A stretch of a line that is covered by cells.
struct Support {
  double t0 = 0, t1 = 0;  ///< along Line2::at [m]
  double support_m = 0;   ///< covered length
  CellIndices cells;
};

/// Quality of a fit, from the cells' weighted residuals.
struct FitQuality {
  double rms_m = 0;
  double sigma_offset_m = 0;  ///< at the cells' centroid
  double sigma_angle_rad = 0;
  double mean_offset_m = 0;  ///< weighted mean of the signed distances: 0 for the line's own fit
};

/// Which of `candidates` lie on `line`.
CellIndices inliers(const WallCells& cells, const CellIndices& candidates, const Line2& line,
                    const FitRules& rules, double distance_m);

/// Iteratively reweighted least squares from `start` on the inliers among `candidates`; with `fixed_angle`
/// the offset only. Returns `start` when fewer than two cells remain.
Line2 fit_line(const WallCells& cells, const CellIndices& candidates, Line2 start, const FitRules& rules,
               bool fixed_angle = false);

/// The stretches of `line` that its cells cover, strongest first. Pieces are joined over gaps up to
/// min(max_gap_m, 0.5 m + 3 × the shorter piece's support): doors and windows do not part a wall, specks do
/// not prolong it.
std::vector<Support> supports(const WallCells& cells, const CellIndices& on_line, const Line2& line,
                              const FitRules& rules);

FitQuality quality(const WallCells& cells, const CellIndices& on_line, const Line2& line);

}  // namespace roomcut::detect_lines

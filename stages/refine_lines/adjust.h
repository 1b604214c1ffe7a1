// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/refine_lines/angle_classes.h"
#include "stages/refine_lines/line_fit.h"

namespace roomcut::refine_lines {

/// All lines together, for Ceres.
struct Adjustment {
  std::vector<LineProblem> lines;
  std::vector<bool> constant;  ///< locked lines: not touched
  std::vector<Pose> poses;     ///< start values in, result out
  AngleClasses classes;        ///< over the lines; angles are adjusted too
  double regularity_rad = 0;   ///< standard deviation of a line's direction about its class; 0 = no classes
};

/// Minimises the sum of Tukey(kTukeyLoss) losses of all residuals, the priors and one residual per member of
/// a class. One thread, so that equal input gives equal bits. Returns whether Ceres converged; poses stay as
/// they were otherwise.
bool adjust(Adjustment& adjustment);

}  // namespace roomcut::refine_lines

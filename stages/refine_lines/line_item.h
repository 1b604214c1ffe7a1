// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/wall_lines/wall_line.h"
#include "stages/refine_lines/line_faces.h"
#include "stages/refine_lines/line_fit.h"

namespace roomcut {

/// A surviving line on its way through the refinement.
struct LineItem {
  WallLine wall;
  std::vector<LineFaces> faces;  ///< one entry; of a merged line those of all that went into it
  std::vector<Observation> observations;
  LineProblem problem;
  LineFit alone;      ///< by its own observations
  LineFit fit;        ///< among the others
  bool stale = true;  ///< `problem` and `alone` are not of these observations
  bool constant = false;
  bool users = false;
  bool keeps_ends = false;  ///< of a line of the user's, or a wall seen from one side
  double area_m2 = 0;
};

/// The line as fitted: its ends where it carries surface (a user's also where drawn), its support, rms and
/// sigmas. A constant one comes back as it is.
WallLine refined(const LineItem& item);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/wall_lines/wall_line.h"
#include "stages/refine_lines/line_faces.h"
#include "stages/refine_lines/line_fit.h"

namespace roomcut::refine_lines {

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
  bool keeps_ends = false;  ///< a hand-edited line, or a wall seen from one side
  double area_m2 = 0;
};

/// The line as fitted: with ends where it carries surface (a hand-edited line also where it was drawn),
/// support, rms and sigmas. A constant line comes back unchanged.
WallLine refined(const LineItem& item);

}  // namespace roomcut::refine_lines

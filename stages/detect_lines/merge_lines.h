// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/detect_lines/line_fit.h"

namespace roomcut::detect_lines {

/// A line with its support, before it gets an id.
struct LineCandidate {
  Line2 line;
  Support support;
  std::string column = {};  ///< name of the column of which it is a side
  int arc = -1;             ///< index of the arc of which it is a chord; -1 = of none
};

struct MergeRules {
  double distance_m = 0;  ///< lines nearer than this, at the weaker one's support centre, are one
  double angle_rad = 0;
  /// The same for a short line beside a long one that both are seen in one slice there: a door frame, neither
  /// a wall's other face nor a wall of another storey.
  double minor_distance_m = 0.06;
  double minor_reach_m = 0.5;  ///< how far beyond the ends of the short one the long one is looked for
  double minor_share = 0.3;    ///< shorter than this share of the other's support
  double reach_m = 2.0;        ///< supports farther apart along the line do not meet in the partition
};

/// Joins near-duplicates to the stronger line, which keeps its place and takes over cells and extent: one
/// doubled line flips everything behind it in the rays. The two faces of a thin wall stay two as long as they
/// are distance_m apart. Returns the remaining lines, strongest first, ties by position. Deterministic.
std::vector<LineCandidate> merge_near_duplicates(const WallCells& cells, std::vector<LineCandidate> lines,
                                                 const MergeRules& rules, const FitRules& fit);

}  // namespace roomcut::detect_lines

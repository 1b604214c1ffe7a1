// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/refine_lines/line_faces.h"
#include "stages/refine_lines/line_fit.h"

namespace roomcut::refine_lines {

/// A refined line as merging sees it.
struct MergeCandidate {
  Line2 line;      ///< refined
  Vec2 centre;     ///< of its observations
  double sigma_m;  ///< of its offset there
  const LineFaces* faces;
  bool users;       ///< locked, edited or added: never merged away
  double strength;  ///< area of its faces [m^2]; order of `id` decides ties
  std::string id;
};

/// For each candidate the index of the one into which it is merged; its own index when it stays. A line goes
/// into a stronger one when both differ by less than `angle_rad`, come within 4.5 m of each other along the
/// line, and lie closer than `distance_m`, or, when they share no place and height (another storey), when the
/// distance is not significant (3 sigma, at least 4 mm). The two faces of a thin wall never merge: solid
/// between them says that they are two.
std::vector<std::size_t> find_merges(const std::vector<MergeCandidate>& candidates, double distance_m,
                                     double angle_rad);

}  // namespace roomcut::refine_lines

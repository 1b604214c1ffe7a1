// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "stages/refine_lines/line_faces.h"
#include "stages/refine_lines/line_fit.h"
#include "stages/refine_lines/one_sided.h"

namespace roomcut::refine_lines {

/// A part of a line whose walls lie in one plane.
struct LinePart {
  LineFaces faces;
  std::vector<Observation> observations;
  std::vector<int> layers;  ///< all but those in which every panel is of another part; ascending
};

/// Detection takes walls that lie in a row, or above each other, for one line when they differ by a
/// centimetre or two. Here each panel, a connected piece of the surface with the empty space on one side, is
/// fitted alone; the offsets along the common direction are split into groups wherever neighbours differ by
/// more than `apart_m` and by more than 4 standard deviations. Largest part first; one part when there is no
/// significant difference. Panels with few observations go with the group that they lie nearest to.
/// `layer_height` [m] apportions the area. Deterministic.
std::vector<LinePart> split_line(const LineFaces& faces, const std::vector<Observation>& observations,
                                 const std::vector<double>& layer_height, const LinePrior& prior,
                                 double apart_m);

/// WallLine::levels of a part of a line that had `whole`: those in which the part may carry a wall, so that
/// it leaves no sliver beside the other part's wall in another storey. Null for all layers.
std::optional<std::vector<int>> levels_of(const LinePart& part, const std::optional<std::vector<int>>& whole);

/// How far a wall seen from one side lies from the nearest surface of the part, in bins and layers: it
/// belongs to the part to which it is nearest.
double steps_to(const LinePart& part, const OneSidedWall& wall);

}  // namespace roomcut::refine_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/refine_lines/line_faces.h"
#include "stages/refine_lines/line_fit.h"

namespace roomcut {

/// A part of a line whose walls lie in one plane.
struct LinePart {
  LineFaces faces;
  std::vector<Observation> observations;
};

/// Detection takes walls that lie in a row, or above each other, for one line when they differ by a
/// centimetre or two. Here their walls are asked: the panels, connected pieces of the surface with the empty
/// space on one side, are fitted alone; their offsets along the common direction fall into groups wherever
/// neighbours differ by more than `apart_m` and by more than 4 standard deviations. Largest part first; one
/// part when the data know no better. Panels with few observations go with the group that they lie nearest
/// to. `layer_height` [m] apportions the area. Deterministic.
std::vector<LinePart> split_line(const LineFaces& faces, const std::vector<Observation>& observations,
                                 const std::vector<double>& layer_height, const LinePrior& prior,
                                 double apart_m);

}  // namespace roomcut

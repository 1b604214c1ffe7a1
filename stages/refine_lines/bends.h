// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "stages/refine_lines/line_faces.h"
#include "stages/refine_lines/line_fit.h"

namespace roomcut::refine_lines {

/// A fitted line with what was observed of the surface that it carries in the first cut.
struct FittedLine {
  Line2 line;
  const LineFaces* faces = nullptr;
  const std::vector<Observation>* observations = nullptr;
};

/// A wall for which there is no line: in the first cut the lines beside it carry its surface, up to where
/// they meet.
struct Bend {
  std::size_t parent = 0;  ///< the fitted line that it is mostly on
  LineFaces faces;
  std::vector<Observation> observations;
};

/// Detection loses walls shorter than about half a metre between two that are turned by a few degrees: the
/// chords of a curved wall. A wall bends where the observations leave their line steadily, beginning on it,
/// turned by 3 … 20°, over 30 cm or more (on one line or on two that meet there). What stands beside a line
/// without meeting it (frames, curtains) does not count. `layer_height` [m] apportions the area. Sorted by
/// parent. Deterministic.
std::vector<Bend> find_bends(const std::vector<FittedLine>& lines, const std::vector<double>& layer_height);

}  // namespace roomcut::refine_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut::refine_lines {

/// A stretch of a line that carries a wall of its own in one layer.
struct CarriedRun {
  std::size_t layer;
  double t0, t1;  ///< along the line [m]
};

/// What a line carries; nothing is known of lines of which the first cut has nothing.
struct CarriedLine {
  bool known = false;
  std::vector<CarriedRun> runs;  ///< by layer, then along the line

  /// Whether the place at `t` is the line's; so is every place of a line of which nothing is known.
  bool holds(std::size_t layer, double t) const;
};

using CarriedRuns = std::vector<CarriedLine>;  ///< one per complex.lines

/// Where each line carries a wall of its own in the first cut: surface between an empty and a solid cell, or
/// wall faces three tenths of which were seen. A stretch is the line's own where no longer line carries
/// something within 4 cm. It must be 30 cm long or a tenth of the line's longest stretch, in its layer or in
/// the one above or below. A wall's line cuts through all storeys; where another wall stands a few
/// centimetres beside it in one of them, or crosses it at a small angle, it takes some of that wall's points
/// and its corner. `label` as in Labels. Deterministic.
CarriedRuns find_carried_runs(const CellComplex& complex, const FaceWeights& weights,
                              const std::vector<std::uint8_t>& label);

/// Restricts detected lines to the layers in which they carry something; a line that carries nothing of its
/// own gets an empty `levels` and is to be dropped. Hand-edited lines stay as they are, and so do lines of
/// which nothing is known. So do lines of `one_sided` that carry nothing of their own; `carried` then has
/// them as unknown.
void restrict_to_carried_layers(const CellComplex& complex, const std::set<std::string>& one_sided,
                                CarriedRuns& carried, WallLines& lines);

}  // namespace roomcut::refine_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "stages/refine_lines/bends.h"

namespace roomcut::refine_lines {

/// The bend of a wall that detection took for one straight line.
struct Hinge {
  std::size_t bin = 0;   ///< first of the raster behind the bend
  Line2 before, behind;  ///< least squares through what was observed on both sides
};

/// Detection lays one line across two chords of a curved wall that are turned by a few degrees; the fit then
/// stands off both. Here two straight lines are put through the observations for every place between two
/// bins, and the best pair is taken where it leaves less than a quarter of the single line's misfit, both are
/// straight to 4 mm, at least 30 cm long and turned by 3 … 20° against each other, and they meet there to 1
/// cm (what stands beside a wall, a frame or a curtain, does not). Null for a straight wall. Deterministic.
std::optional<Hinge> find_hinge(const FittedLine& fitted);

}  // namespace roomcut::refine_lines

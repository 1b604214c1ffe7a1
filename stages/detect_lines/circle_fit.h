// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/detect_lines/line_fit.h"

namespace roomcut::detect_lines {

/// A circle, or a straight line where the curvature is 0, by a point on it: so a gentle bend and none at all
/// are no different in kind, and both fit well.
struct Bend {
  Vec2 point{0, 0};
  Vec2 normal{1, 0};     ///< at `point`, of length 1
  double curvature = 0;  ///< positive: the centre lies where the normal points to [1/m]

  double radius() const { return 1 / std::abs(curvature); }
  Vec2 centre() const { return point + normal / curvature; }
  /// Signed distance of p, positive on the side the normal points to [m].
  double distance(const Vec2& p) const;
};

/// Iteratively reweighted least squares (Cauchy weights of scale `cauchy_m`, cells weighted by area) of the
/// distances, from `start` on; with `straight` the curvature stays 0. The point stays beside that of `start`.
Bend fit_bend(const WallCells& cells, const CellIndices& group, Bend start, double cauchy_m,
              bool straight = false);

}  // namespace roomcut::detect_lines

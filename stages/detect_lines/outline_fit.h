// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "stages/detect_lines/line_fit.h"

namespace roomcut::detect_lines {

/// A closed outline in plan: a rectangle, or a circle.
struct Outline {
  bool round = false;
  Vec2 centre{0, 0};
  double theta = 0;              ///< direction of the rectangle's first axis [rad]
  std::array<double, 2> half{};  ///< half of its sides along and across theta; the radius, twice [m]

  double perimeter_m() const;
  /// Distance of p from the outline, negative inside [m].
  double distance(const Vec2& p) const;
  /// Where along the outline p is nearest, 0 ... perimeter [m]; of a rectangle side after side, from the
  /// corner at (+, -) counter-clockwise.
  double along(const Vec2& p) const;
};

/// An outline with the mean square of the cells' distances from it, weighted by area and at most
/// `kOutlierSpread` noise each.
struct OutlineFit {
  Outline outline;
  double variance_m2 = 0;
};

struct OutlineRules {
  double tau_m = 0.04;      ///< edge of the cells; those so near a corner belong to both sides
  double outlier_m = 0.03;  ///< a cell farther off counts as this far off
};

/// The rectangle of any direction that fits best.
OutlineFit fit_rectangle(const WallCells& cells, const CellIndices& group, const OutlineRules& rules);

/// The rectangle of direction `theta` that fits best.
OutlineFit fit_rectangle(const WallCells& cells, const CellIndices& group, double theta,
                         const OutlineRules& rules);

/// The circle that fits best.
OutlineFit fit_circle(const WallCells& cells, const CellIndices& group, const OutlineRules& rules);

/// The outline of the size and direction of `like` that fits best, from its centre on.
OutlineFit fit_same(const WallCells& cells, const CellIndices& group, const Outline& like,
                    const OutlineRules& rules);

}  // namespace roomcut::detect_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/wall_lines/wall_line.h"
#include "stages/refine_lines/line_item.h"

namespace roomcut::refine_lines {

/// A circle and what its observations say of it.
struct CircleFit {
  Vec2 centre{0, 0};
  double radius_m = 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of centre and radius
  bool usable = false;                                   ///< false: the circle is the one that came
};

/// Robust fit (Tukey's loss, Ceres, one thread) of a circle to observations near it, from the circle that
/// came; `ends` are points on that: a weak prior of `prior_m` holds the circle near them and near the middle
/// between, where nothing was observed. The covariance is (J'J)^-1 times the mean square of the residuals,
/// where that is above one.
CircleFit fit_circle(const CircleFit& came, const std::vector<Vec2>& ends, double prior_m,
                     const std::vector<Observation>& observations);

/// Takes the chords of curved walls out of `items`, by the name of their arc: all others are left, in their
/// order.
std::map<std::string, std::vector<LineItem>> take_arcs(std::vector<LineItem>& items, const Frame& frame);

/// The chords of one arc, refined as the circle that they are on: all move with it and keep their azimuths,
/// so that they still meet. Locked ones stay. `chords` must not be empty; `prior_m`: how far the arc may have
/// to move.
std::vector<WallLine> refine_arc(const std::vector<LineItem>& chords, const Frame& frame, double prior_m);

}  // namespace roomcut::refine_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "common/geometry/line2.h"

namespace roomcut {

/// A line that may turn by `turn` [rad] about a fixed point `centre` and shift by `shift` [m] along its
/// turned normal: n(theta0 + turn)·(p - centre) = shift. About the centroid of its observations the two are
/// nearly uncorrelated.
struct Pose {
  double turn = 0;
  double shift = 0;
};

/// The residual of one observation, in standard deviations: ((p - centre)·n(theta0 + turn) - shift) / sigma,
/// and its derivatives. (e, t) are p - centre along and across n(theta0).
struct LineResidual {
  double e, t;   ///< along the normal, along the direction of the unturned line [m]
  double sigma;  ///< [m]

  double value(const Pose& pose) const {
    return (std::cos(pose.turn) * e + std::sin(pose.turn) * t - pose.shift) / sigma;
  }
  double by_turn(const Pose& pose) const {
    return (-std::sin(pose.turn) * e + std::cos(pose.turn) * t) / sigma;
  }
  double by_shift() const { return -1.0 / sigma; }
};

/// The line that a pose of `line` about `centre` is.
inline Line2 posed(const Line2& line, const Vec2& centre, const Pose& pose) {
  const double theta = line.theta + pose.turn;
  return normalised(theta, std::cos(theta) * centre.x() + std::sin(theta) * centre.y() + pose.shift);
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "common/geometry/line2.h"

namespace roomcut::refine_lines {

/// A line that may turn by `turn` [rad] about a fixed point `centre` and shift by `shift` [m] along its
/// turned normal: n(theta0 + turn)·(p - centre) = shift. About the centroid of its observations the two are
/// nearly uncorrelated.
struct Pose {
  double turn = 0;
  double shift = 0;
};

/// A pose with the turn's cosine and sine, for many residuals.
struct TurnedPose {
  explicit TurnedPose(const Pose& pose)
      : cosine(std::cos(pose.turn)), sine(std::sin(pose.turn)), shift(pose.shift) {}
  double cosine, sine, shift;
};

/// The residual of one observation, in standard deviations: ((p - centre)·n(theta0 + turn) - shift) / sigma,
/// and its derivatives. (e, t) are p - centre along and across n(theta0).
struct LineResidual {
  double e, t;   ///< along the normal, along the direction of the unturned line [m]
  double sigma;  ///< [m]

  double value(const TurnedPose& pose) const {
    return (pose.cosine * e + pose.sine * t - pose.shift) / sigma;
  }
  double value(const Pose& pose) const { return value(TurnedPose(pose)); }
  double by_turn(const TurnedPose& pose) const { return (-pose.sine * e + pose.cosine * t) / sigma; }
  double by_turn(const Pose& pose) const { return by_turn(TurnedPose(pose)); }
  double by_shift() const { return -1.0 / sigma; }
};

/// The line that a pose of `line` about `centre` is.
inline Line2 posed(const Line2& line, const Vec2& centre, const Pose& pose) {
  const double theta = line.theta + pose.turn;
  return normalised(theta, std::cos(theta) * centre.x() + std::sin(theta) * centre.y() + pose.shift);
}

}  // namespace roomcut::refine_lines

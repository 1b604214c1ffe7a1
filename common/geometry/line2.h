// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace roomcut {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// An infinite line in the horizontal plane in Hesse form: n(theta)·p = d with n = (cos theta, sin theta).
/// theta in [0, pi) [rad], d in metres from the frame's origin. d moves by lever arm × angle: compare
/// distances between lines at a support's centroid, never by d.
struct Line2 {
  double theta = 0;
  double d = 0;

  Vec2 normal() const { return {std::cos(theta), std::sin(theta)}; }
  /// Unit vector along the line, the normal turned by +90 degrees.
  Vec2 direction() const { return {-std::sin(theta), std::cos(theta)}; }
  /// Signed distance of p: positive on the side the normal points to [m].
  double distance(const Vec2& p) const { return normal().dot(p) - d; }
  /// Coordinate of p along the line, measured from the foot of the origin [m].
  double along(const Vec2& p) const { return direction().dot(p); }
  /// The point at coordinate t along the line.
  Vec2 at(double t) const { return d * normal() + t * direction(); }
};

/// Brings theta into [0, pi), turning d's sign with it.
inline Line2 normalised(double theta, double d) {
  constexpr double kPi = std::numbers::pi;
  const double turns = std::floor(theta / kPi);
  theta -= turns * kPi;
  if (theta >= kPi) {  // rounding at the upper end
    theta -= kPi;
    d = -d;
  }
  if (std::fmod(std::abs(turns), 2.0) == 1.0) {
    d = -d;
  }
  return {theta, d};
}

/// The line through two different points.
inline Line2 line_through(const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double theta = std::atan2(-along.x(), along.y());  // normal = direction turned by -90 degrees
  return normalised(theta, std::cos(theta) * a.x() + std::sin(theta) * a.y());
}

/// Angle between two undirected directions, in [0, pi/2] [rad].
inline double angle_between(double theta_a, double theta_b) {
  const double difference = std::abs(std::remainder(theta_a - theta_b, std::numbers::pi));
  return difference;
}

}  // namespace roomcut

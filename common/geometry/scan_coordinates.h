// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "common/artefact/provenance.h"
#include "common/geometry/level_turn.h"

namespace roomcut {

/// Between local coordinates and the scan's own (metres, z up, where the scan had them): the one place for
/// the frame's origin and for turning back what was levelled. Files for people are written in the scan's own.
class ScanCoordinates {
 public:
  explicit ScanCoordinates(const Frame& frame)
      : turn_(level_turn(frame.level)), origin_(frame.origin[0], frame.origin[1], frame.origin[2]) {}

  Vec3 to_scan(const Vec3& local) const { return turn_.transpose() * local + origin_; }
  Vec3 to_local(const Vec3& scan) const { return turn_ * (scan - origin_); }

  /// A place of the plan: of the local point above it or below at the height of the origin, which lies in the
  /// building. Where a scan was not levelled, all heights have the same place.
  Vec2 plan_to_scan(const Vec2& local) const { return plan_turn() * local + origin_.head<2>(); }
  Vec2 plan_to_local(const Vec2& scan) const { return plan_turn().inverse() * (scan - origin_.head<2>()); }
  /// How plan_to_scan() turns and stretches: the identity but for levelled scans.
  Eigen::Matrix2d plan_turn() const { return turn_.topLeftCorner<2, 2>().transpose(); }

  /// A height as captions say it: at the origin of the plan.
  double caption_height(double local) const { return height_to_scan({0, 0}, local); }
  /// A height at a place of the plan; `place` is local both times.
  double height_to_scan(const Vec2& place, double local) const {
    return to_scan(Vec3(place.x(), place.y(), local)).z();
  }
  double height_to_local(const Vec2& place, double scan) const {
    return (scan - origin_.z() - turn_.col(2).head<2>().dot(place)) / turn_(2, 2);
  }

 private:
  Eigen::Matrix3d turn_;
  Vec3 origin_;
};

/// A local coordinate read from a file that holds the scan's own to 1e-6 m, without what a far origin leaves
/// of rounding: the same number wherever the building stands.
inline double without_rounding(double metres) {
  const double result = std::round(metres * 1e7) / 1e7;
  return result == 0 ? 0 : result;
}
inline Vec2 without_rounding(const Vec2& p) {
  return {without_rounding(p.x()), without_rounding(p.y())};
}

}  // namespace roomcut

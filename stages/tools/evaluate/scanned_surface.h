// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <unordered_set>

#include "common/geometry/line2.h"

namespace roomcut::evaluate {

/// Where a scan has points. Tells a wall from an opening in it, whatever the truth's rooms say: their bodies
/// end at a door up to the ceiling as they do at a wall. Memory grows with the surface, not with the points.
class ScannedSurface {
 public:
  /// `density_per_m2`: of the points; decides how far around a place is looked: 10 to 30 cm.
  explicit ScannedSurface(double density_per_m2);
  void add(const Vec3& p);
  /// Whether `p` lies in a scanned surface with this normal: points within 5 cm of its plane in at least
  /// three of the four quadrants (left, right; up, down) around it. False in an opening up to its jambs.
  bool surrounds(const Vec3& p, const Vec3& unit_normal) const;
  double radius_m() const { return radius_; }

 private:
  std::uint64_t key(const Vec3& p) const;
  bool has_point(const Vec3& p, const Vec3& x, const Vec3& y, const Vec3& off, int steps_off) const;
  double radius_, edge_;
  std::unordered_set<std::uint64_t> voxels_;
};

}  // namespace roomcut::evaluate

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/tools/synthesize/surfaces.h"

namespace roomcut::synthesize {

/// Round patches of surface without points, 0.2 … 0.8 m in radius, that together cover a given share.
class Holes {
 public:
  Holes(const Scene& scene, const Building& building, const Surfaces& surfaces);
  bool covers(const Vec3& p) const;

 private:
  struct Patch {
    Vec3 centre;
    double radius;
  };
  std::vector<Patch> patches_;
  PlanIndex index_;
};

/// Cumulated areas of triangles: a share of the whole area to a triangle.
class AreaTable {
 public:
  explicit AreaTable(const std::vector<SurfaceTriangle>& triangles);
  double total() const { return sum_.empty() ? 0 : sum_.back(); }  ///< [m^2]
  /// The triangle at `area` in [0, total).
  std::size_t find(double area) const;

 private:
  std::vector<double> sum_;
};

/// Evenly distributed in the triangle for a, b even in [0, 1).
Vec3 point_in(const SurfaceTriangle& triangle, double a, double b);

}  // namespace roomcut::synthesize

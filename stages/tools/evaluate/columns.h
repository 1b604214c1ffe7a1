// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace roomcut::evaluate {

/// Where a vertical line passes through the surface of a closed mesh.
struct Crossing {
  double z = 0;                ///< [m]
  std::int32_t component = 0;  ///< of the triangle
  std::int32_t step = 0;       ///< going up: +1 into the enclosed space, -1 out of it
};

struct Interval {
  double lo = 0, hi = 0;
  double length() const { return hi - lo; }
};

/// Vertical lines through a closed mesh with normals out of the enclosed space. The mesh must outlive it;
/// queries are const and thread-safe. A line through an edge or a corner is treated as if it ran past it on
/// one side, the same one for all triangles there: every line crosses the surface an even number of times.
class Columns {
 public:
  explicit Columns(const TriangleMesh& mesh);

  /// All crossings at (x, y), ascending.
  void crossings(double x, double y, std::vector<Crossing>& out) const;
  /// Whether p lies in the enclosed space.
  bool inside(const Vec3& p) const;
  /// The component that encloses p; -1 = none.
  std::int32_t component_at(const Vec3& p) const;
  std::int32_t components() const { return components_; }
  std::int32_t component_of(std::int32_t triangle) const {
    return component_[static_cast<std::size_t>(triangle)];
  }

 private:
  void cross(std::int32_t triangle, double x, double y, std::vector<Crossing>& out) const;

  const TriangleMesh& mesh_;
  std::vector<std::int32_t> component_;
  std::int32_t components_ = 0;
  Vec2 corner_{0, 0};  // of the grid
  double cell_ = 1;
  std::int64_t nx_ = 0, ny_ = 0;
  std::vector<std::int64_t> offset_;  // per grid cell, into triangle_
  std::vector<std::int32_t> triangle_;
};

/// The enclosed parts of a column, from its crossings (of one component, or of all for component < 0).
void enclosed(const std::vector<Crossing>& crossings, std::int32_t component, std::vector<Interval>& out);
/// Length of the intersection of two sorted lists of disjoint intervals.
double overlap(const std::vector<Interval>& a, const std::vector<Interval>& b);
double total_length(const std::vector<Interval>& intervals);
/// The parts of sorted, disjoint `parts` within [lo, hi].
void clip(const std::vector<Interval>& parts, double lo, double hi, std::vector<Interval>& out);
/// Sorts intervals and joins those that meet.
void unite(std::vector<Interval>& intervals);
/// What sorted, disjoint `from` holds beside sorted, disjoint `what`.
void subtract(const std::vector<Interval>& from, const std::vector<Interval>& what,
              std::vector<Interval>& out);

}  // namespace roomcut::evaluate

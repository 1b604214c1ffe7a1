// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stages/tools/synthesize/building.h"
#include "stages/tools/synthesize/truth.h"

namespace roomcut::synthesize {

/// Items of a plan by square cells, for "what is near this point".
class PlanIndex {
 public:
  PlanIndex() = default;
  /// Covers [lo, hi] with cells of `edge` metres.
  PlanIndex(const Vec2& lo, const Vec2& hi, double edge);
  void add(std::int32_t item, const Vec2& lo, const Vec2& hi);
  /// Items whose boxes may hold p; empty outside.
  const std::vector<std::int32_t>& at(const Vec2& p) const;

 private:
  int cell(double x, int axis) const;
  Vec2 lo_{0, 0};
  double edge_ = 1;
  int nx_ = 0, ny_ = 0;
  std::vector<std::vector<std::int32_t>> cells_;
};

/// What a point comes from.
enum class PointOrigin : std::uint8_t { kTruth, kFurniture, kReveal };

struct SurfaceTriangle {
  Vec3 a, u, v;  ///< corner and two sides [m]
  PointOrigin kind;
};

/// The same triangles in the same order; no two share a vertex.
TriangleMesh triangle_mesh(const std::vector<SurfaceTriangle>& triangles);

/// All surfaces that give points, and what hides them.
class Surfaces {
 public:
  Surfaces(const Scene& scene, const Building& building, const TriangleMesh& truth);

  const std::vector<SurfaceTriangle>& triangles() const { return triangles_; }
  /// Whether a point of such a surface is inside furniture or right behind or below it.
  bool hidden(const Vec3& p, PointOrigin kind) const;
  /// The window that holds the point p of the truth's surface, or null.
  const WallOpening* window_at(const Vec3& p) const;

 private:
  void add_furniture(const Scene& scene);
  void add_reveals();
  void add_parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v, PointOrigin kind);
  bool in_room(const Scene& scene, const Vec3& p) const;

  const Building& building_;
  std::vector<SurfaceTriangle> triangles_;
  PlanIndex furniture_, windows_;
};

}  // namespace roomcut::synthesize

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/scanned_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomcut::evaluate {

namespace {

constexpr double kPointsAround = 16;  // four in each quadrant, where the scan is as dense as in most places
constexpr double kNearest = 0.1, kFarthest = 0.3;  // [m]
constexpr int kSteps = 4;                          // voxels in the radius
constexpr double kOnPlane = 0.05;                  // [m]
constexpr int kQuadrants = 3;  // of a surface beside another one a quadrant may be hidden; of a jamb two are

}  // namespace

ScannedSurface::ScannedSurface(double density_per_m2)
    : radius_(
          std::clamp(std::sqrt(kPointsAround / (std::numbers::pi * density_per_m2)), kNearest, kFarthest)),
      edge_(radius_ / kSteps) {}

std::uint64_t ScannedSurface::key(const Vec3& p) const {
  constexpr int kBits = 21;
  constexpr std::int64_t kHalf = std::int64_t{1} << (kBits - 1);
  std::uint64_t out = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto index = std::clamp(static_cast<std::int64_t>(std::floor(p[axis] / edge_)), -kHalf, kHalf - 1);
    out = out << kBits | static_cast<std::uint64_t>(index + kHalf);
  }
  return out;
}

void ScannedSurface::add(const Vec3& p) {
  voxels_.insert(key(p));
}

bool ScannedSurface::surrounds(const Vec3& p, const Vec3& unit_normal) const {
  // Along the surface: level, and straight up it; any two for a floor.
  const Vec3 helper = std::abs(unit_normal.z()) > 0.9 ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitZ());
  const Vec3 level = helper.cross(unit_normal).normalized();
  const Vec3 up = unit_normal.cross(level);
  const int steps_off = static_cast<int>(kOnPlane / edge_);
  int seen = 0;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      seen += has_point(p, x * edge_ * level, y * edge_ * up, edge_ * unit_normal, steps_off) ? 1 : 0;
    }
  }
  return seen >= kQuadrants;
}

/// Whether a voxel is occupied in the quarter disc between `x` and `y` from p, or up to so many `off` from
/// it.
bool ScannedSurface::has_point(const Vec3& p, const Vec3& x, const Vec3& y, const Vec3& off,
                               int steps_off) const {
  for (int k = -steps_off; k <= steps_off; ++k) {
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps && i * i + j * j < kSteps * kSteps; ++j) {
        if (voxels_.contains(key(p + k * off + (i + 0.5) * x + (j + 0.5) * y))) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace roomcut::evaluate

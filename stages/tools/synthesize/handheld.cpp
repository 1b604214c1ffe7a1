// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/handheld.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "stages/tools/synthesize/random_draws.h"

namespace roomcut::synthesize {

namespace {

constexpr std::uint64_t kStream = 0x68616e64;
constexpr std::uint64_t kWaves = 48;
constexpr double kDriftReach = 6;   // [m] correlation of the drift: about a room
constexpr int kPlanes = 3;          // that meet in a corner
constexpr double kRounding = 1e-9;  // [m]

/// The triangles of the building itself.
TriangleMesh building_mesh(const std::vector<SurfaceTriangle>& triangles) {
  std::vector<SurfaceTriangle> building;
  for (const SurfaceTriangle& triangle : triangles) {
    if (triangle.kind == PointOrigin::kTruth) building.push_back(triangle);
  }
  return triangle_mesh(building);
}

}  // namespace

SmoothField::SmoothField(double sigma_m, double correlation_m, std::uint64_t seed, std::uint64_t stream) {
  if (sigma_m <= 0) return;
  const double scale = sigma_m * std::sqrt(2.0 / static_cast<double>(kWaves));
  for (std::uint64_t i = 0; i < kWaves; ++i) {
    PointDraws draws(seed, stream, i);
    const auto normal3 = [&draws] {
      const auto [x, y] = draws.normals();
      return Vec3(x, y, draws.normals().first);
    };
    const Vec3 number = normal3() / correlation_m;
    const Vec3 amplitude = scale * normal3();
    waves_.push_back({number, amplitude, 2 * std::numbers::pi * draws.unit()});
  }
}

Vec3 SmoothField::at(const Vec3& p) const {
  Vec3 sum = Vec3::Zero();
  for (const Wave& wave : waves_) sum += std::cos(wave.number.dot(p) + wave.phase) * wave.amplitude;
  return sum;
}

Handheld::Handheld(const Scene& scene, const Surfaces& surfaces)
    : rounding_(scene.handheld.rounding_m),
      warp_(scene.handheld.warp_m, scene.handheld.correlation_m, scene.seed, kStream),
      drift_(scene.handheld.drift_m, kDriftReach, scene.seed, kStream + 1) {
  if (rounding_ > 0) truth_.emplace(building_mesh(surfaces.triangles()));
}

Vec3 Handheld::measured(const Vec3& p, const SurfaceTriangle& triangle) const {
  Vec3 place = p;
  if (truth_ && triangle.kind == PointOrigin::kTruth) {
    place = rounded(p, triangle.u.cross(triangle.v).normalized());
  }
  return place + warp_.at(p) + drift_.at(p);
}

/// In a corner as a ball of the rounding's radius that rolls inside the room leaves it.
Vec3 Handheld::rounded(const Vec3& p, const Vec3& outwards) const {
  Vec3 centre = p - rounding_ * outwards;
  bool moved = false;
  for (int plane = 0; plane < kPlanes; ++plane) {
    const MeshTree::Hit hit = truth_->nearest(centre, rounding_ - kRounding);
    if (hit.triangle < 0) break;
    centre -= (rounding_ - hit.distance) * truth_->unit_normal(hit.triangle);
    moved = true;
  }
  return moved ? centre + rounding_ * (p - centre).normalized() : p;
}

}  // namespace roomcut::synthesize

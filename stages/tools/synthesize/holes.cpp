// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors/codes.h"
#include "common/random/counter_random.h"
#include "stages/tools/synthesize/scene_limits.h"

namespace roomcut::synthesize {

namespace {

constexpr std::uint64_t kStream = 0x686f6c65;      // of the random numbers
constexpr std::size_t kProbes = 20000;             // points that measure the covered share
constexpr double kSmallest = 0.2, kLargest = 0.8;  // radii [m]
constexpr double kPi = std::numbers::pi;

}  // namespace

AreaTable::AreaTable(const std::vector<SurfaceTriangle>& triangles) {
  double sum = 0;
  for (const SurfaceTriangle& t : triangles) sum_.push_back(sum += 0.5 * t.u.cross(t.v).norm());
}

std::size_t AreaTable::find(double area) const {
  const auto found = std::upper_bound(sum_.begin(), sum_.end(), area);
  return std::min(static_cast<std::size_t>(found - sum_.begin()), sum_.size() - 1);
}

Vec3 point_in(const SurfaceTriangle& triangle, double a, double b) {
  if (a + b > 1) {
    a = 1 - a;
    b = 1 - b;
  }
  return triangle.a + a * triangle.u + b * triangle.v;
}

Holes::Holes(const Scene& scene, const Building& building, const Surfaces& surfaces)
    : index_(building.lo.head<2>() - Vec2::Constant(kLargest),
             building.hi.head<2>() + Vec2::Constant(kLargest), kLargest) {
  const AreaTable areas(surfaces.triangles());
  std::uint64_t counter = 0;
  const auto draw = [&] { return random_unit(scene.seed, kStream, counter++); };
  const auto draw_point = [&] {
    const auto& triangle = surfaces.triangles()[areas.find(draw() * areas.total())];
    const double a = draw();
    return point_in(triangle, a, draw());
  };
  const double patch_m2 = kPi / 3 * (kLargest * kLargest + kLargest * kSmallest + kSmallest * kSmallest);
  if (-std::log(1 - scene.holes) * areas.total() / patch_m2 > scene_limits::kPatches) {
    throw StageError(errors::kSceneInvalid, scene.name,
                     "so large a surface would take more than " +
                         std::to_string(std::llround(scene_limits::kPatches)) + " round holes",
                     "lower \"holes\"; copies made by \"repeat\" share theirs");
  }
  std::vector<Vec3> open;
  for (std::size_t i = 0; i < kProbes && scene.holes > 0; ++i) open.push_back(draw_point());
  const auto wanted = static_cast<std::size_t>((1 - scene.holes) * kProbes);
  while (open.size() > wanted && static_cast<double>(patches_.size()) < 2 * scene_limits::kPatches) {
    const Vec3 centre = draw_point();
    const double radius = kSmallest + (kLargest - kSmallest) * draw();
    const Vec2 reach = Vec2::Constant(radius);
    index_.add(static_cast<std::int32_t>(patches_.size()), centre.head<2>() - reach,
               centre.head<2>() + reach);
    patches_.push_back({centre, radius});
    std::erase_if(open, [&](const Vec3& p) { return (p - centre).squaredNorm() < radius * radius; });
  }
}

bool Holes::covers(const Vec3& p) const {
  const auto& near = index_.at(p.head<2>());
  return std::any_of(near.begin(), near.end(), [&](std::int32_t i) {
    return (p - patches_[i].centre).squaredNorm() < patches_[i].radius * patches_[i].radius;
  });
}

}  // namespace roomcut::synthesize

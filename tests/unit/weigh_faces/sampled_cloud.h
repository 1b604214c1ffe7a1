// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "common/cloud/cloud.h"
#include "common/random/counter_random.h"

namespace roomcut::weigh_faces {

/// Random points on the surfaces of made-up rooms, with noise across the surface; classes as ingest would
/// give them.
class SampledCloud {
 public:
  SampledCloud(double density, double noise, std::uint64_t seed = 1)
      : density_(density), noise_(noise), seed_(seed) {}

  CloudTile tile;
  /// Keeps a point with this probability; (x, y, z) -> 0 … 1. Set it before adding surfaces.
  std::function<double(const Vec3&)> keep;

  CloudHeader header() const {
    CloudHeader h;
    h.noise_m = noise_;
    h.density = density_;
    h.points = tile.size();
    return h;
  }
  void wall(const Vec2& a, const Vec2& b, double z0, double z1) {
    const Vec2 along = b - a;
    const Vec2 n(-along.y() / along.norm(), along.x() / along.norm());
    double theta = std::atan2(n.y(), n.x());
    theta = theta < 0 ? theta + std::numbers::pi : theta;
    const auto azimuth =
        static_cast<std::uint8_t>(static_cast<int>(theta / std::numbers::pi * kAzimuthSteps) % kAzimuthSteps);
    const auto count = static_cast<std::size_t>(density_ * along.norm() * (z1 - z0));
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 p = a + unit() * along + gauss() * n;
      point({p.x(), p.y(), z0 + unit() * (z1 - z0)}, SurfaceClass::kWall, azimuth);
    }
  }
  void flat(double x0, double x1, double y0, double y1, double z) {
    const auto count = static_cast<std::size_t>(density_ * (x1 - x0) * (y1 - y0));
    for (std::size_t i = 0; i < count; ++i) {
      point({x0 + unit() * (x1 - x0), y0 + unit() * (y1 - y0), z + gauss()}, SurfaceClass::kHorizontal, 0);
    }
  }
  /// Four walls, floor and ceiling of a box, seen from inside.
  void room(double x0, double x1, double y0, double y1, double z0, double z1, bool with_ceiling = true) {
    wall({x0, y0}, {x1, y0}, z0, z1);
    wall({x1, y0}, {x1, y1}, z0, z1);
    wall({x1, y1}, {x0, y1}, z0, z1);
    wall({x0, y1}, {x0, y0}, z0, z1);
    flat(x0, x1, y0, y1, z0);
    if (with_ceiling) {
      flat(x0, x1, y0, y1, z1);
    }
  }
  void point(const Vec3& p, SurfaceClass surface, std::uint8_t azimuth) {
    if (keep && unit() > keep(p)) {
      return;
    }
    tile.x.push_back(static_cast<float>(p.x()));
    tile.y.push_back(static_cast<float>(p.y()));
    tile.z.push_back(static_cast<float>(p.z()));
    tile.surface.push_back(static_cast<std::uint8_t>(surface));
    tile.azimuth.push_back(azimuth);
    tile.area.push_back(static_cast<float>(1 / density_));
  }

 private:
  double unit() { return random_unit(seed_, 7, counter_++); }
  double gauss() {
    const double r = std::sqrt(-2 * std::log(1 - unit()));
    return noise_ * r * std::cos(2 * std::numbers::pi * unit());
  }

  double density_, noise_;
  std::uint64_t seed_, counter_ = 0;
};

}  // namespace roomcut::weigh_faces

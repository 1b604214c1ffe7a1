// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "common/cloud/cloud.h"
#include "common/geometry/line2.h"
#include "common/random/counter_random.h"
#include "stages/slice/tile_source.h"

namespace roomcut::testing {
using namespace roomcut::slice;

/// Points on made-up surfaces, classified as ingest would, in tiles. Everything follows from the seed.
class SyntheticCloud {
 public:
  explicit SyntheticCloud(double noise_m = 0.004, double density = 500, std::uint64_t seed = 1)
      : noise_(noise_m), density_(density), seed_(seed) {}

  double noise() const { return noise_; }
  /// Turns all that is added from now on about the origin and moves it.
  void place(double angle_rad, const Vec2& shift) {
    angle_ = angle_rad;
    shift_ = shift;
  }
  /// Density of what is added from now on, as a function of the place before turning.
  void thin(std::function<double(const Vec2&)> share) { share_ = std::move(share); }

  void surface(const Vec2& lo, const Vec2& hi, const std::function<double(const Vec2&)>& z,
               SurfaceClass of_class) {
    const std::uint64_t stream = ++streams_;
    const auto n = static_cast<std::uint64_t>((hi - lo).prod() * density_);
    for (std::uint64_t i = 0; i < n; ++i) {
      const Vec2 p(lo.x() + (hi.x() - lo.x()) * unit(stream, 4 * i),
                   lo.y() + (hi.y() - lo.y()) * unit(stream, 4 * i + 1));
      if (dropped(p, stream, i)) continue;
      add(p, z(p) + noise_ * normal(stream, 4 * i + 2), of_class, 0);
    }
  }
  void horizontal(const Vec2& lo, const Vec2& hi, const std::function<double(const Vec2&)>& z) {
    surface(lo, hi, z, SurfaceClass::kHorizontal);
  }
  void horizontal(const Vec2& lo, const Vec2& hi, double z) {
    horizontal(lo, hi, [z](const Vec2&) { return z; });
  }
  void wall(const Vec2& a, const Vec2& b, double z0, double z1, SurfaceClass surface = SurfaceClass::kWall) {
    const std::uint64_t stream = ++streams_;
    const Line2 line = line_through(a, b);
    const auto n = static_cast<std::uint64_t>((b - a).norm() * (z1 - z0) * density_);
    for (std::uint64_t i = 0; i < n; ++i) {
      const Vec2 on = a + unit(stream, 4 * i) * (b - a);
      if (dropped(on, stream, i)) continue;
      const Vec2 p = on + noise_ * normal(stream, 4 * i + 2) * line.normal();
      add(p, z0 + (z1 - z0) * unit(stream, 4 * i + 1), surface, line.theta + angle_);
    }
  }
  /// The inner faces of a room, its floor and its ceiling.
  void room(const Vec2& lo, const Vec2& hi, double floor, double ceiling) {
    horizontal(lo, hi, floor);
    horizontal(lo, hi, ceiling);
    const Vec2 right(hi.x(), lo.y());
    const Vec2 left(lo.x(), hi.y());
    for (const auto& [a, b] :
         {std::pair{lo, right}, std::pair{right, hi}, std::pair{hi, left}, std::pair{left, lo}}) {
      wall(a, b, floor, ceiling);
      truth_.emplace_back(turned(a), turned(b));
    }
  }
  /// Ends of the walls that room() made.
  const std::vector<std::pair<Vec2, Vec2>>& true_walls() const { return truth_; }

  CloudHeader header() const {
    CloudHeader header;
    header.noise_m = noise_;
    header.density = density_;
    header.tile_edge_m = kTileEdge;
    header.bbox_min.setConstant(1e9);
    header.bbox_max.setConstant(-1e9);
    for (const auto& [place, tile] : tiles_) {
      header.points += tile.size();
      for (std::size_t i = 0; i < tile.size(); ++i) {
        const Vec3 p(tile.x[i], tile.y[i], tile.z[i]);
        header.bbox_min = header.bbox_min.cwiseMin(p);
        header.bbox_max = header.bbox_max.cwiseMax(p);
      }
    }
    return header;
  }

  /// Visits the tiles on TBB, the last one first.
  TileSource source() const {
    std::vector<const CloudTile*> list;
    for (const auto& [place, tile] : tiles_) list.push_back(&tile);
    std::reverse(list.begin(), list.end());
    return [list](const TileVisitor& visit) {
      tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t i) { visit(i, *list[i]); });
    };
  }

 private:
  static constexpr double kTileEdge = 2.5;

  Vec2 turned(const Vec2& p) const {
    const double c = std::cos(angle_);
    const double s = std::sin(angle_);
    return Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()) + shift_;
  }
  double unit(std::uint64_t stream, std::uint64_t i) const { return random_unit(seed_, stream, i); }
  double normal(std::uint64_t stream, std::uint64_t i) const {
    const double u = 1 - unit(stream + (1ULL << 32U), 2 * i);
    return std::sqrt(-2 * std::log(u)) *
           std::cos(2 * std::numbers::pi * unit(stream + (1ULL << 32U), 2 * i + 1));
  }
  bool dropped(const Vec2& p, std::uint64_t stream, std::uint64_t i) const {
    return share_ && unit(stream, 4 * i + 3) > share_(p);
  }
  void add(const Vec2& before, double z, SurfaceClass surface, double theta) {
    const Vec2 p = turned(before);
    CloudTile& tile = tiles_[{static_cast<int>(std::floor(p.y() / kTileEdge)),
                              static_cast<int>(std::floor(p.x() / kTileEdge))}];
    tile.x.push_back(static_cast<float>(p.x()));
    tile.y.push_back(static_cast<float>(p.y()));
    tile.z.push_back(static_cast<float>(z));
    tile.surface.push_back(static_cast<std::uint8_t>(surface));
    const double azimuth = normalised(theta, 0).theta / std::numbers::pi * kAzimuthSteps;
    const bool upright = surface == SurfaceClass::kWall;
    tile.azimuth.push_back(upright ? static_cast<std::uint8_t>(std::min(azimuth, 255.0)) : std::uint8_t{0});
    tile.area.push_back(static_cast<float>(1 / (density_ * (share_ ? share_(before) : 1.0))));
  }

  double noise_, density_;
  std::uint64_t seed_;
  std::uint64_t streams_ = 0;
  double angle_ = 0;
  Vec2 shift_{0, 0};
  std::function<double(const Vec2&)> share_;
  std::map<std::pair<int, int>, CloudTile> tiles_;
  std::vector<std::pair<Vec2, Vec2>> truth_;
};

}  // namespace roomcut::testing

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/tripod.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors/codes.h"
#include "stages/tools/synthesize/scene_limits.h"

namespace roomcut::synthesize {

namespace {

constexpr std::uint64_t kStream = 0x74726970;
constexpr std::uint64_t kBlockRays = 1 << 16;
constexpr double kTrialStep = 0.02;  // of the pattern that estimates how many beams return [rad]
constexpr double kNearest = 1e-6;    // surfaces nearer to a scanner are not seen [m]
constexpr double kJitter = 0.5;      // beams leave within this share of a step [steps]
constexpr double kPi = std::numbers::pi;
constexpr double kAround = 0.5;  // outliers lie in the bounding box enlarged by this [m]

}  // namespace

TripodSource::TripodSource(const Scene& scene, const Building& building, const Surfaces& surfaces)
    : scene_(scene),
      building_(building),
      surfaces_(surfaces),
      tree_(triangle_mesh(surfaces.triangles())),
      holes_(scene, building, surfaces),
      handheld_(scene, surfaces) {
  if (building.stations.empty()) {
    throw StageError(errors::kSceneInvalid, scene.name, "there is no scanner position",
                     "give sampling.stations, or let a room be scanned");
  }
  set_step(kTrialStep);
  const double share = return_share();
  if (share < scene_limits::kLeastShare) {
    throw StageError(errors::kSceneInvalid, scene.name, "hardly any beam of the scanners returns",
                     "put sampling.stations inside the rooms");
  }
  const double scans = static_cast<double>(copies(scene) * building.stations.size());
  const double rays = static_cast<double>(scene.sampling.points) / (share * scans);
  set_step(std::sqrt(2 * kPi * (kPi - scene.sampling.blind_cone) / rays));
  expected_ = static_cast<std::uint64_t>(share * scans * static_cast<double>(columns_ * rows_));
}

void TripodSource::set_step(double step) {
  step_ = step;
  columns_ = static_cast<std::uint64_t>(std::max(1.0, std::round(2 * kPi / step)));
  rows_ = static_cast<std::uint64_t>(std::max(1.0, std::round((kPi - scene_.sampling.blind_cone) / step)));
  columns_per_block_ = std::max<std::uint64_t>(1, kBlockRays / rows_);
  blocks_per_station_ = (columns_ + columns_per_block_ - 1) / columns_per_block_;
}

/// Share of the beams of the present pattern that give a point.
double TripodSource::return_share() const {
  std::uint64_t returned = 0;
  std::uint64_t rays = 0;
  for (const Vec3& station : building_.stations) {
    for (std::uint64_t c = 0; c < columns_; ++c) {
      for (std::uint64_t r = 0; r < rows_; ++r) {
        PointDraws draws(scene_.seed, kStream + 1, rays++);
        if (measure(station, static_cast<double>(c), static_cast<double>(r), draws)) ++returned;
      }
    }
  }
  return static_cast<double>(returned) / static_cast<double>(rays);
}

SetUp TripodSource::set_up(std::uint64_t block) const {
  const std::uint64_t scan = block / blocks_per_station_;
  const std::size_t stations = building_.stations.size();
  return {scan, building_.stations[scan % stations] + copy_offset(scene_, building_, scan / stations)};
}

void TripodSource::make(std::uint64_t block, std::vector<float>& xyz) const {
  const std::uint64_t scan = block / blocks_per_station_;
  const Vec3& station = building_.stations[scan % building_.stations.size()];
  const Vec3 offset = copy_offset(scene_, building_, scan / building_.stations.size());
  const std::uint64_t begin = block % blocks_per_station_ * columns_per_block_;
  const std::uint64_t end = std::min(columns_, begin + columns_per_block_);
  for (std::uint64_t c = begin; c < end; ++c) {
    for (std::uint64_t r = 0; r < rows_; ++r) {
      PointDraws draws(scene_.seed, kStream, (scan * columns_ + c) * rows_ + r);
      const auto p = measure(station, static_cast<double>(c), static_cast<double>(r), draws);
      if (!p) continue;
      const Vec3 q = *p + offset;
      xyz.insert(xyz.end(),
                 {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z())});
    }
  }
}

/// One beam; none when nothing comes back.
std::optional<Vec3> TripodSource::measure(const Vec3& station, double column, double row,
                                          PointDraws& draws) const {
  const double azimuth = 2 * kPi * (column + kJitter * (draws.unit() - 0.5)) / static_cast<double>(columns_);
  const double span = kPi - scene_.sampling.blind_cone;
  const double elevation =
      kPi / 2 - span + span * (row + 0.5 + kJitter * (draws.unit() - 0.5)) / static_cast<double>(rows_);
  const Vec3 direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                       std::sin(elevation));
  const MeshTree::Hit hit = tree_.first_on_ray(station, direction, kNearest, scene_.sampling.max_range);
  if (hit.triangle < 0) return std::nullopt;
  if (draws.unit() < scene_.outliers) {
    const Vec3 size = building_.hi - building_.lo + Vec3::Constant(2 * kAround);
    const Vec3 share(draws.unit(), draws.unit(), draws.unit());
    return building_.lo - Vec3::Constant(kAround) + size.cwiseProduct(share);
  }
  double range = hit.distance;
  const Vec3 p = station + range * direction;
  if (surfaces_.triangles()[hit.triangle].kind == PointOrigin::kTruth) {
    if (const WallOpening* window = surfaces_.window_at(p)) {
      const auto further = through_window(*window, p, direction);
      if (!further) return std::nullopt;
      range += *further;
    }
  }
  if (holes_.covers(station + range * direction)) return std::nullopt;
  const SurfaceTriangle& triangle = surfaces_.triangles()[static_cast<std::size_t>(hit.triangle)];
  return handheld_.measured(station + range * direction, triangle) +
         scene_.noise_m * draws.normals().first * direction;
}

/// From where the beam enters the recess to its reveal; none when it leaves through the pane.
std::optional<double> TripodSource::through_window(const WallOpening& window, const Vec3& p,
                                                   const Vec3& direction) const {
  const double across = direction.head<2>().dot(window.right);
  const double into = direction.head<2>().dot(window.outwards);
  if (into <= 0) return std::nullopt;
  const double side = (p.head<2>() - window.centre).dot(window.right);
  const double to_pane = window.depth / into;
  const double to_side =
      across == 0 ? to_pane : ((across > 0 ? window.width / 2 : -window.width / 2) - side) / across;
  const double to_end =
      direction.z() == 0 ? to_pane : ((direction.z() > 0 ? window.z1 : window.z0) - p.z()) / direction.z();
  const double nearest = std::min(to_side, to_end);
  if (nearest >= to_pane) return std::nullopt;
  return nearest;
}

}  // namespace roomcut::synthesize

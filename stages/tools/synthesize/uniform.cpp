// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/uniform.h"

#include <algorithm>
#include <bit>

#include "stages/tools/synthesize/random_draws.h"

namespace roomcut::synthesize {

namespace {

constexpr std::uint64_t kStream = 0x756e6966;
constexpr std::uint64_t kBlock = 1 << 16;  // points
constexpr int kAttempts = 64;              // for a visible place; after these the point is taken where it is
constexpr double kAround = 0.5;            // outliers lie in the bounding box enlarged by this [m]

}  // namespace

UniformSource::UniformSource(const Scene& scene, const Building& building, const Surfaces& surfaces)
    : scene_(scene),
      building_(building),
      surfaces_(surfaces),
      areas_(surfaces.triangles()),
      holes_(scene, building, surfaces),
      handheld_(scene, surfaces),
      points_(scene.sampling.points) {}

std::uint64_t UniformSource::blocks() const {
  return (points_ + kBlock - 1) / kBlock;
}

void UniformSource::make(std::uint64_t block, std::vector<float>& xyz) const {
  const std::uint64_t end = std::min(points_, (block + 1) * kBlock);
  for (std::uint64_t i = block * kBlock; i < end; ++i) {
    const Vec3 p = point(scene_.sampling.shuffled ? shuffled(i) : i);
    xyz.insert(xyz.end(), {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
}

/// A permutation of 0 … points-1: a four-round Feistel network on the next even number of bits, walked until
/// it falls inside.
std::uint64_t UniformSource::shuffled(std::uint64_t i) const {
  const int half = (std::bit_width(points_ - 1) + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {
    std::uint64_t left = i >> half;
    std::uint64_t right = i & mask;
    for (std::uint64_t round = 0; round < 4; ++round) {
      const std::uint64_t next = left ^ (random_bits(scene_.seed, kStream + 1 + round, right) & mask);
      left = right;
      right = next;
    }
    i = left << half | right;
  } while (i >= points_);
  return i;
}

Vec3 UniformSource::point(std::uint64_t i) const {
  const std::uint64_t least =
      points_ / copies(scene_);  // every copy has as many points or one more, the first ones more
  const std::uint64_t longer = points_ % copies(scene_);
  const std::uint64_t split = longer * (least + 1);
  const std::uint64_t copy = i < split ? i / (least + 1) : longer + (i - split) / least;
  const std::uint64_t first = copy * least + std::min(copy, longer);
  const double in_copy = static_cast<double>(copy < longer ? least + 1 : least);
  PointDraws draws(scene_.seed, kStream, i);
  Vec3 p;
  if (draws.unit() < scene_.outliers) {
    const Vec3 size = building_.hi - building_.lo + Vec3::Constant(2 * kAround);
    const Vec3 share(draws.unit(), draws.unit(), draws.unit());
    p = building_.lo - Vec3::Constant(kAround) + size.cwiseProduct(share);
  } else {
    p = surface_point((static_cast<double>(i - first) + draws.unit()) / in_copy, draws);
    const auto [x, y] = draws.normals();
    p += scene_.noise_m * Vec3(x, y, draws.normals().first);
  }
  return p + copy_offset(scene_, building_, copy);
}

/// The place at `share` of the surface; when it cannot be seen, another one anywhere.
Vec3 UniformSource::surface_point(double share, PointDraws& draws) const {
  Vec3 p;
  const SurfaceTriangle* from = nullptr;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const SurfaceTriangle& triangle = surfaces_.triangles()[areas_.find(share * areas_.total())];
    from = &triangle;
    const double a = draws.unit();
    p = point_in(triangle, a, draws.unit());
    const bool in_window = triangle.kind == PointOrigin::kTruth && surfaces_.window_at(p) != nullptr;
    if (!in_window && !surfaces_.hidden(p, triangle.kind) && !holes_.covers(p)) break;
    share = draws.unit();
  }
  return handheld_.measured(p, *from);
}

}  // namespace roomcut::synthesize

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "common/cloud/cloud.h"
#include "stages/ingest/ingest.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

/// A scan made in memory.
class MemoryScan : public ScanReader {
 public:
  explicit MemoryScan(std::vector<Vec3> points, std::vector<Vec3> normals = {},
                      std::size_t per_block = 20'000)
      : points_(std::move(points)), normals_(std::move(normals)), per_block_(per_block) {}

  std::size_t blocks() const override { return (points_.size() + per_block_ - 1) / per_block_; }
  bool has_normals() const override { return !normals_.empty(); }
  const std::vector<Vec3>& stations() const override { return stations_; }
  double resolution(double /*magnitude*/) const override { return 0; }
  void read(std::size_t index, ScanBlock& block) const override {
    const std::size_t first = index * per_block_;
    block.resize(std::min(per_block_, points_.size() - first), has_normals());
    for (std::size_t i = 0; i < block.size(); ++i) {
      block.x[i] = points_[first + i].x();
      block.y[i] = points_[first + i].y();
      block.z[i] = points_[first + i].z();
      if (has_normals()) {
        block.nx[i] = static_cast<float>(normals_[first + i].x());
        block.ny[i] = static_cast<float>(normals_[first + i].y());
        block.nz[i] = static_cast<float>(normals_[first + i].z());
      }
    }
  }

 private:
  std::vector<Vec3> points_, normals_;
  std::vector<Vec3> stations_;
  std::size_t per_block_;
};

/// A room with a floor, a ceiling and four walls, turned about the vertical, its corner at `corner`.
struct Room {
  Vec3 size{6, 5, 2.6};
  double angle = 0;  ///< [rad]
  Vec3 corner{0.31, -1.27, 0.13};
  double noise_m = 0.005;
  double density = 1000;  ///< points per square metre

  double surface() const { return 2 * (size.x() * size.y() + size.x() * size.z() + size.y() * size.z()); }
  Vec3 to_world(const Vec3& p) const {
    return corner + Vec3(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                         std::sin(angle) * p.x() + std::cos(angle) * p.y(), p.z());
  }
  Vec3 to_room(const Vec3& world) const {
    const Vec3 p = world - corner;
    return {std::cos(angle) * p.x() + std::sin(angle) * p.y(),
            -std::sin(angle) * p.x() + std::cos(angle) * p.y(), p.z()};
  }
  /// Random points on all six faces, face after face.
  std::vector<Vec3> points(unsigned seed = 1) const {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> error(0, noise_m > 0 ? noise_m : 1e-12);
    std::vector<Vec3> result;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {0.0, 1.0}) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const auto count = std::lround(size[u] * size[v] * density);
        for (long i = 0; i < count; ++i) {
          Vec3 p;
          p[axis] = side * size[axis] + error(random);
          p[u] = unit(random) * size[u];
          p[v] = unit(random) * size[v];
          result.push_back(to_world(p));
        }
      }
    }
    return result;
  }
  /// The face's axis (0, 1: walls, 2: floor or ceiling) nearest to a point, or -1 when the second nearest
  /// face is closer than `clear`.
  int face_at(const Vec3& world, double clear) const {
    const Vec3 p = to_room(world);
    std::array<std::pair<double, int>, 6> distance;
    std::size_t face = 0;
    for (int axis = 0; axis < 3; ++axis) {
      distance[face++] = {std::abs(p[axis]), axis};
      distance[face++] = {std::abs(p[axis] - size[axis]), axis};
    }
    std::sort(distance.begin(), distance.end());
    return distance[1].first < clear ? -1 : distance[0].second;
  }
};

/// A cloud as ingest makes it, in memory.
struct MadeCloud {
  CloudHeader header;
  std::vector<CloudTile> tiles;
  IngestCounts counts;
  std::size_t largest_part = 0;  ///< points that were handed over at once
};

inline void append(const CloudTile& part, CloudTile& tile) {
  const auto join = [](const auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
  join(part.x, tile.x);
  join(part.y, tile.y);
  join(part.z, tile.z);
  join(part.surface, tile.surface);
  join(part.azimuth, tile.azimuth);
  join(part.area, tile.area);
}

inline MadeCloud make_cloud(const ScanReader& reader, const ScanSettings& settings = {},
                            const IngestParams& params = {}) {
  MadeCloud cloud;
  const TiledScan scan = tile_scan(reader, settings, params);
  cloud.header = header_of(scan, reader.stations(), reader.crs(), params);
  const SurfaceSummary summary =
      class_tiles(scan, params, [&, first = true](const CloudTile& part, bool last) mutable {
        cloud.largest_part = std::max(cloud.largest_part, part.size());
        if (first) {
          cloud.tiles.push_back(part);
        } else {
          append(part, cloud.tiles.back());
        }
        first = last;
      });
  cloud.header.noise_m = noise_of(summary.estimates, scan.step_m);
  cloud.header.density = density_of(summary.estimates);
  cloud.counts = scan.counts;
  return cloud;
}

/// Calls visit(position in the scan's frame, class, azimuth, area) for every point.
template <class Visit>
void for_points(const MadeCloud& cloud, Visit&& visit) {
  const Vec3 origin(cloud.header.frame.origin[0], cloud.header.frame.origin[1], cloud.header.frame.origin[2]);
  for (const CloudTile& tile : cloud.tiles) {
    for (std::size_t i = 0; i < tile.size(); ++i) {
      visit(Vec3(tile.x[i], tile.y[i], tile.z[i]) + origin, static_cast<SurfaceClass>(tile.surface[i]),
            tile.azimuth[i], static_cast<double>(tile.area[i]));
    }
  }
}

}  // namespace roomcut::testing

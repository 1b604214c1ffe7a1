// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/page_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/mesh/nearest_triangles.h"

namespace roomcut::report {

namespace {

constexpr int kFar = 255;
constexpr double kUnits = 65535;

}  // namespace

std::vector<MeshTree::Hit> nearest_of_model(const std::vector<ThinPoint>& points, const TriangleMesh& model) {
  std::vector<Vec3> places;
  places.reserve(points.size());
  for (const ThinPoint& point : points) {
    places.push_back(point.at);
  }
  return nearest_triangles(model, places, kFar * kDistanceStep_m);
}

PagePoints pack_points(const std::vector<ThinPoint>& points, const std::vector<MeshTree::Hit>& nearest) {
  PagePoints packed;
  if (points.empty()) {
    return packed;
  }
  Vec3 high = points.front().at;
  packed.low = high;
  for (const ThinPoint& point : points) {
    packed.low = packed.low.cwiseMin(point.at);
    high = high.cwiseMax(point.at);
  }
  packed.step = (high - packed.low).cwiseMax(1e-6) / kUnits;
  packed.xyz.reserve(3 * points.size());
  packed.surface.reserve(points.size());
  for (const ThinPoint& point : points) {
    const Vec3 units = (point.at - packed.low).cwiseQuotient(packed.step);
    for (int axis = 0; axis < 3; ++axis) {  // never negative; half a unit more is rounded down
      packed.xyz.push_back(static_cast<std::uint16_t>(std::min(units[axis] + 0.5, kUnits)));
    }
    packed.surface.push_back(point.surface);
  }
  packed.distance.reserve(nearest.size());
  for (const MeshTree::Hit& hit : nearest) {
    packed.distance.push_back(static_cast<std::uint8_t>(
        std::min<double>(kFar, std::min(hit.distance, 1.0) / kDistanceStep_m + 0.5)));
  }
  return packed;
}

std::vector<float> region_distances(const std::vector<MeshTree::Hit>& nearest, const TriangleMesh& model,
                                    std::size_t regions) {
  std::vector<double> sum(regions, 0);
  std::vector<std::size_t> count(regions, 0);
  for (const MeshTree::Hit& hit : nearest) {
    if (hit.triangle >= 0 && hit.distance < kFar * kDistanceStep_m) {
      const auto region = static_cast<std::size_t>(model.region[static_cast<std::size_t>(hit.triangle)]);
      sum[region] += hit.distance * hit.distance;
      ++count[region];
    }
  }
  std::vector<float> rms(regions, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t r = 0; r < regions; ++r) {
    if (count[r] > 0) {
      rms[r] = static_cast<float>(std::sqrt(sum[r] / static_cast<double>(count[r])));
    }
  }
  return rms;
}

}  // namespace roomcut::report

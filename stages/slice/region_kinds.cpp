// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/region_kinds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stages/slice/merge_regions.h"
#include "stages/slice/surface_graph.h"

namespace roomcut::slice {
namespace {

constexpr double kNarrowest_m = 0.5;
constexpr double kSteepestDrift = 0.04;  ///< rise per metre that floors of mobile scans have
constexpr double kGentle = 0.1;          ///< rise per metre; a piece of a drifting floor may be so steep
constexpr double kUneven = 0.015;        ///< of the rise
constexpr double kRough_m = 0.01;        ///< boards and plaster

std::pair<double, double> heights(const PlanarRegion& region, const std::vector<SurfaceVoxel>& voxels) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const std::uint32_t i : region.voxels) {
    const double z = region.plane.height(voxels[i].moments.mean().head<2>());
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return {low, high};
}

/// Whether the points leave the plane by more than noise and a part of its rise: then it is a piece of
/// something bent, as the drifting floor of a mobile scan is.
bool is_bent(const PlanarRegion& region, const std::vector<SurfaceVoxel>& voxels, double noise_m) {
  const auto [low, high] = heights(region, voxels);
  const double uneven = kUneven * (high - low);
  const double most = region.plane.pitch() < kBuiltSlope ? uneven : std::max(uneven, kRough_m);
  return region.plane.rms_m > std::hypot(1.1 * noise_m, most);
}

/// Makes the gentle planes bent that go on smoothly into something bent.
void spread_drift(const std::vector<PlanarRegion>& regions, const std::vector<SurfaceVoxel>& voxels,
                  const VoxelGraph& graph, std::vector<RegionKind>& kinds) {
  const std::vector<std::int32_t> region_of = regions_of(regions, voxels.size());
  const auto gentle = [&](std::size_t r) { return regions[r].plane.pitch() < kGentle; };
  DisjointSets surfaces(regions.size());
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (region_of[i] < 0 || !gentle(static_cast<std::size_t>(region_of[i]))) continue;
    const auto own = static_cast<std::size_t>(region_of[i]);
    if (kinds[own] == RegionKind::kLevel) continue;
    for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
      const std::int32_t beside = region_of[graph.neighbours[k]];
      if (beside < 0 || beside == region_of[i]) continue;
      const auto other = static_cast<std::size_t>(beside);
      if (!gentle(other) || kinds[other] == RegionKind::kLevel) continue;
      const std::size_t a = surfaces.root(own);
      const std::size_t b = surfaces.root(other);
      if (a != b) surfaces.join_roots(a, b);
    }
  }
  std::vector<std::uint8_t> bent(regions.size(), 0);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (gentle(r) && kinds[r] == RegionKind::kBent) bent[surfaces.root(r)] = 1;
  }
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (gentle(r) && bent[surfaces.root(r)] != 0 && kinds[r] == RegionKind::kPlane)
      kinds[r] = RegionKind::kBent;
  }
}

}  // namespace

bool slopes(const PlanarRegion& region, const std::vector<SurfaceVoxel>& voxels, double noise_m) {
  const double pitch = region.plane.pitch();
  if (pitch < kGentlestPlane || pitch > kSteepestPlane) return false;
  const auto [low, high] = heights(region, voxels);
  return high - low > std::max(0.08, (pitch < kSteepestDrift ? 16 : 12) * noise_m);
}

bool is_wide(const PlanarRegion& region) {
  return region.plane.width_m >= kNarrowest_m;
}

std::vector<RegionKind> region_kinds(const std::vector<PlanarRegion>& regions,
                                     const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
                                     double noise_m) {
  std::vector<RegionKind> kinds;
  kinds.reserve(regions.size());
  for (const PlanarRegion& region : regions) {
    const bool rises = slopes(region, voxels, noise_m);
    kinds.push_back(!rises                                                        ? RegionKind::kLevel
                    : !is_wide(region) || region.moments.area_m2 < kPlaneLeast_m2 ? RegionKind::kScrap
                    : is_bent(region, voxels, noise_m)                            ? RegionKind::kBent
                                                                                  : RegionKind::kPlane);
  }
  spread_drift(regions, voxels, graph, kinds);
  return kinds;
}

}  // namespace roomcut::slice

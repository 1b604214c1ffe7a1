// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/merge_regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace roomcut::slice {
namespace {

constexpr double kGap_m = 1.0;
constexpr std::int32_t kPlanReach = 3, kHeightReach = 4;  ///< voxels
using Pair = std::pair<std::size_t, std::size_t>;

/// Collects the voxels again, by region.
void refit(std::vector<PlanarRegion>& regions, const std::vector<SurfaceVoxel>& voxels,
           const std::vector<std::int32_t>& region_of) {
  for (PlanarRegion& region : regions) {
    region.voxels.clear();
    region.moments = {};
  }
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (region_of[i] < 0) continue;
    PlanarRegion& region = regions[static_cast<std::size_t>(region_of[i])];
    region.voxels.push_back(static_cast<std::uint32_t>(i));
    region.moments += voxels[i].moments;
  }
  for (PlanarRegion& region : regions) {
    if (!region.voxels.empty()) region.plane = fit_plane(region.moments);
  }
}

bool on_one_plane(const PlanarRegion& a, const PlanarRegion& b, double noise_m) {
  const double off = std::max(0.01, noise_m);
  Moments sum = a.moments;
  sum += b.moments;
  const SpacePlane joint = fit_plane(sum);
  const auto lies_on = [&](const PlanarRegion& r) {
    return r.moments.square_distance(joint) <= r.plane.rms_m * r.plane.rms_m + off * off;
  };
  return lies_on(a) && lies_on(b);
}

/// Pairs of sloped regions with voxels less than the gap apart.
std::set<Pair> neighbours(const std::vector<PlanarRegion>& regions, const std::vector<SurfaceVoxel>& voxels,
                          double min_pitch) {
  std::vector<std::int32_t> region_of = regions_of(regions, voxels.size());
  const auto slopes = [&](std::size_t r) { return regions[r].plane.pitch() >= min_pitch; };
  std::set<Pair> pairs;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (!slopes(r)) continue;
    for (const std::uint32_t i : regions[r].voxels) {
      const Vec3 middle = voxels[i].moments.mean();
      for_each_near(voxels, voxels[i].key, kPlanReach, kHeightReach, [&](std::size_t j) {
        const std::int32_t other = region_of[j];
        if (other <= static_cast<std::int32_t>(r) || !slopes(static_cast<std::size_t>(other))) return;
        if ((voxels[j].moments.mean() - middle).norm() < kGap_m) {
          pairs.emplace(r, static_cast<std::size_t>(other));
        }
      });
    }
  }
  return pairs;
}

}  // namespace

std::vector<std::int32_t> regions_of(const std::vector<PlanarRegion>& regions, std::size_t voxels) {
  std::vector<std::int32_t> region_of(voxels, -1);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    for (const std::uint32_t i : regions[r].voxels) region_of[i] = static_cast<std::int32_t>(r);
  }
  return region_of;
}

void settle_borders(std::vector<PlanarRegion>& regions, const std::vector<SurfaceVoxel>& voxels,
                    const VoxelGraph& graph, double apart_m) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<std::int32_t> before = regions_of(regions, voxels.size());
    std::vector<std::int32_t> after = before;
    bool moved = false;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      if (before[i] < 0) continue;
      const auto misfit = [&](std::int32_t r) {
        return voxels[i].moments.square_distance(regions[static_cast<std::size_t>(r)].plane);
      };
      double least = misfit(before[i]);
      for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
        const std::int32_t other = before[graph.neighbours[k]];
        if (other < 0 || other == after[i] || misfit(other) >= least || misfit(other) > apart_m * apart_m) {
          continue;
        }
        least = misfit(other);
        after[i] = other;
        moved = true;
      }
    }
    if (!moved) return;
    refit(regions, voxels, after);
  }
}

void merge_regions(std::vector<PlanarRegion>& regions, const std::vector<SurfaceVoxel>& voxels,
                   double noise_m, double min_pitch) {
  const std::set<Pair> pairs = neighbours(regions, voxels, min_pitch);
  std::vector<std::size_t> into(regions.size());
  std::iota(into.begin(), into.end(), std::size_t{0});
  const auto root = [&](std::size_t r) {
    while (into[r] != r) r = into[r];
    return r;
  };
  bool merged = true;
  while (merged) {
    merged = false;
    for (const auto& [first, second] : pairs) {
      const std::size_t a = std::min(root(first), root(second));
      const std::size_t b = std::max(root(first), root(second));
      if (a == b || !on_one_plane(regions[a], regions[b], noise_m)) continue;
      regions[a].voxels.insert(regions[a].voxels.end(), regions[b].voxels.begin(), regions[b].voxels.end());
      regions[a].moments += regions[b].moments;
      regions[a].plane = fit_plane(regions[a].moments);
      regions[b] = {};
      into[b] = a;
      merged = true;
    }
  }
  std::erase_if(regions, [](const PlanarRegion& region) { return region.voxels.empty(); });
  for (PlanarRegion& region : regions) std::sort(region.voxels.begin(), region.voxels.end());
}

}  // namespace roomcut::slice

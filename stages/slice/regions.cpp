// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/regions.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

namespace roomcut::slice {
namespace {

constexpr std::int32_t kFewest = 6;  ///< points that show a plane
constexpr double kFlat = 0.1;        ///< variance across a plane over the smaller one in it

/// Largest spread of one voxel's points about their plane.
double spread(double noise_m) {
  return std::max(0.012, 2.5 * noise_m);
}

VoxelPatch patch_of(const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph, std::size_t i,
                    double noise_m) {
  const double most = spread(noise_m);
  const auto flat = [&](const SpacePlane& plane) {
    return plane.rms_m <= most && plane.rms_m * plane.rms_m * 12 < kFlat * plane.width_m * plane.width_m;
  };
  const auto around = [&](auto&& lies_near) {
    Moments sum = voxels[i].moments;
    for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
      const Moments& other = voxels[graph.neighbours[k]].moments;
      if (lies_near(other)) sum += other;
    }
    return sum;
  };
  SpacePlane own = fit_quickly(voxels[i].moments);
  if (voxels[i].count < kFewest || !flat(own)) {
    if (voxels[i].count >= 4 * kFewest && own.rms_m > most) return {};
    own = fit_quickly(around([](const Moments&) { return true; }));
    if (!flat(own)) return {};
  }
  const Moments sum = around([&](const Moments& m) { return m.square_distance(own) <= 4 * most * most; });
  VoxelPatch patch{fit_quickly(sum), sum.area_m2};
  if (!flat(patch.plane)) return {};
  return patch;
}

struct BlockSum {
  Moments moments;
  std::int64_t count = 0;
  int level = -1;  ///< not yet known
};

/// By regression of heights, a tenth of the cost of a fit.
bool is_level(const BlockSum& block, double noise_m) {
  constexpr double kNarrowest_m = 0.15;  // standard deviation in plan
  constexpr double kLeaning = 0.005;     // 0.3 degrees
  if (block.count < 2 * kFewest) return false;
  const Eigen::Matrix3d c = block.moments.covariance();
  const double determinant = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1);
  const double narrowest = kNarrowest_m * kNarrowest_m;
  if (std::min(c(0, 0), c(1, 1)) < narrowest || determinant < narrowest * narrowest) return false;
  const double gx = (c(0, 2) * c(1, 1) - c(1, 2) * c(0, 1)) / determinant;
  const double gy = (c(1, 2) * c(0, 0) - c(0, 2) * c(0, 1)) / determinant;
  const double off = c(2, 2) - gx * c(0, 2) - gy * c(1, 2);
  const double most = 1.5 * noise_m + 0.001;
  return std::hypot(gx, gy) <= kLeaning && off <= most * most;
}

/// Grows one region from a seed.
class Growth {
 public:
  Growth(const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
         const std::vector<VoxelPatch>& patches, const RegionRules& rules, std::vector<std::uint8_t>& taken)
      : voxels_(voxels), graph_(graph), patches_(patches), rules_(rules), taken_(taken) {}

  PlanarRegion from(std::size_t seed) {
    PlanarRegion region;
    region.plane = patches_[seed].plane;
    add(region, seed);
    refit_at_ = kFirstRefit;
    for (std::size_t next = 0; next < region.voxels.size(); ++next) {
      const std::size_t i = region.voxels[next];
      for (std::uint32_t k = graph_.first[i]; k < graph_.first[i + 1]; ++k) {
        const std::size_t j = graph_.neighbours[k];
        if (taken_[j] == 0 && fits(region.plane, j)) add(region, j);
      }
      if (region.voxels.size() >= refit_at_) {
        region.plane = fit_plane(region.moments);
        refit_at_ = region.voxels.size() + region.voxels.size() / 4;
      }
    }
    trim(region);
    return region;
  }

  bool may_begin(std::size_t i) const {
    const double pitch = patches_[i].plane.pitch();
    return taken_[i] == 0 && patches_[i].area_m2 > 0 && pitch >= rules_.min_pitch &&
           pitch <= rules_.max_pitch;
  }

 private:
  static constexpr std::size_t kFirstRefit = 12;

  bool fits(const SpacePlane& plane, std::size_t i) const {
    const VoxelPatch& patch = patches_[i];
    if (patch.area_m2 <= 0 || patch.plane.normal.dot(plane.normal) < std::cos(rules_.turned)) return false;
    if (patch.plane.pitch() < rules_.min_pitch) return false;
    const double most = spread(rules_.noise_m) + rules_.apart_m;
    return std::abs(voxels_[i].moments.distance(plane)) <= rules_.apart_m &&
           voxels_[i].moments.square_distance(plane) <= most * most;
  }
  void add(PlanarRegion& region, std::size_t i) {
    taken_[i] = 1;
    region.voxels.push_back(static_cast<std::uint32_t>(i));
    region.moments += voxels_[i].moments;
  }
  /// Sets voxels free that the last plane has left, and fits the rest.
  void trim(PlanarRegion& region) {
    region.plane = fit_plane(region.moments);
    std::vector<std::uint32_t> kept;
    region.moments = {};
    std::sort(region.voxels.begin(), region.voxels.end());
    for (const std::uint32_t i : region.voxels) {
      if (!fits(region.plane, i)) {
        taken_[i] = 0;
        continue;
      }
      kept.push_back(i);
      region.moments += voxels_[i].moments;
    }
    region.voxels = std::move(kept);
    if (!region.voxels.empty()) region.plane = fit_plane(region.moments);
  }

  const std::vector<SurfaceVoxel>& voxels_;
  const VoxelGraph& graph_;
  const std::vector<VoxelPatch>& patches_;
  const RegionRules& rules_;
  std::vector<std::uint8_t>& taken_;
  std::size_t refit_at_ = 0;
};

}  // namespace

void level_blocks(const std::vector<SurfaceVoxel>& voxels, double noise_m, std::vector<std::uint8_t>& taken) {
  const auto block_of = [](const CellKey& key) { return CellKey{key.ix >> 2, key.iy >> 2, key.iz}; };
  CellTable<BlockSum> table;
  for (const SurfaceVoxel& voxel : voxels) {
    BlockSum& block = table.at(block_of(voxel.key));
    block.moments += voxel.moments;
    block.count += voxel.count;
  }
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    BlockSum& block = table.at(block_of(voxels[i].key));
    if (block.level < 0) block.level = is_level(block, noise_m) ? 1 : 0;
    taken[i] = static_cast<std::uint8_t>(block.level);
  }
}

std::vector<VoxelPatch> voxel_patches(const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
                                      double noise_m, const std::vector<std::uint8_t>& taken) {
  std::vector<VoxelPatch> patches(voxels.size());
  tbb::parallel_for(std::size_t{0}, voxels.size(), [&](std::size_t i) {
    if (taken[i] == 0) patches[i] = patch_of(voxels, graph, i, noise_m);
  });
  return patches;
}

std::vector<PlanarRegion> grow_regions(const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
                                       const std::vector<VoxelPatch>& patches, const RegionRules& rules,
                                       double min_m2, std::vector<std::uint8_t>& taken) {
  std::vector<std::uint32_t> seeds(voxels.size());
  std::iota(seeds.begin(), seeds.end(), 0U);
  std::erase_if(seeds, [&](std::uint32_t i) { return patches[i].area_m2 <= 0; });
  std::stable_sort(seeds.begin(), seeds.end(), [&](std::uint32_t a, std::uint32_t b) {
    return patches[a].plane.rms_m < patches[b].plane.rms_m;
  });
  Growth growth(voxels, graph, patches, rules, taken);
  std::vector<PlanarRegion> regions;
  for (const std::uint32_t seed : seeds) {
    if (!growth.may_begin(seed)) continue;
    PlanarRegion region = growth.from(seed);
    if (region.moments.area_m2 >= min_m2) {
      regions.push_back(std::move(region));
    } else {
      for (const std::uint32_t i : region.voxels) taken[i] = 0;
    }
  }
  return regions;
}

}  // namespace roomcut::slice

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/facets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "stages/slice/merge_regions.h"
#include "stages/slice/region_kinds.h"
#include "stages/slice/surface_graph.h"

namespace roomcut::slice {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLeast_m2 = 0.8, kVault_m2 = 4;  ///< one facet, and those side by side
constexpr double kApart_m = 0.06, kTurned = 15 * kDegree, kRms_m = 0.04;
constexpr double kGentlest = 3 * kDegree;

class FacetFinder {
 public:
  FacetFinder(const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
              const std::vector<VoxelPatch>& patches, double noise_m, std::vector<std::uint8_t>& taken)
      : voxels_(voxels), graph_(graph), patches_(patches), noise_m_(noise_m), taken_(taken) {}

  std::vector<PlanarRegion> find(const std::vector<PlanarRegion>& planes) {
    std::vector<PlanarRegion> facets = grow(kBuiltSlope);
    const std::vector<std::uint8_t> counts = vaults(facets);
    keep(facets, [&](std::size_t f) { return counts[f] != 0; });
    std::vector<std::uint8_t> beside(voxels_.size(), 0);
    mark_beside(facets, beside);
    mark_beside(planes, beside);
    std::vector<PlanarRegion> crown = grow(kGentlest);
    keep(crown, [&](std::size_t f) {
      return std::any_of(crown[f].voxels.begin(), crown[f].voxels.end(),
                         [&](std::uint32_t i) { return beside[i] != 0; });
    });
    facets.insert(facets.end(), std::make_move_iterator(crown.begin()), std::make_move_iterator(crown.end()));
    return facets;
  }

 private:
  std::vector<PlanarRegion> grow(double min_pitch) {
    const RegionRules rules{noise_m_, std::max(kApart_m, 3 * noise_m_), kTurned, min_pitch, kSteepestPlane};
    std::vector<PlanarRegion> facets = grow_regions(voxels_, graph_, patches_, rules, kLeast_m2, taken_);
    keep(facets, [&](std::size_t f) {
      return facets[f].plane.rms_m <= std::max(kRms_m, 2 * noise_m_) && is_wide(facets[f]) &&
             slopes(facets[f], voxels_, noise_m_);
    });
    return facets;
  }

  /// Keeps the facets for which `good(index)` holds, and sets the voxels of the others free.
  template <class Good>
  void keep(std::vector<PlanarRegion>& facets, const Good& good) {
    std::vector<PlanarRegion> kept;
    for (std::size_t f = 0; f < facets.size(); ++f) {
      if (good(f)) {
        kept.push_back(facets[f]);
      } else {
        for (const std::uint32_t i : facets[f].voxels) taken_[i] = 0;
      }
    }
    facets = std::move(kept);
  }

  /// For each facet, whether it and those that it touches, and so on, are enough.
  std::vector<std::uint8_t> vaults(const std::vector<PlanarRegion>& facets) const {
    const std::vector<std::int32_t> facet_of = regions_of(facets, voxels_.size());
    DisjointSets sets(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
      for (const std::uint32_t i : facets[f].voxels) {
        for (std::uint32_t k = graph_.first[i]; k < graph_.first[i + 1]; ++k) {
          const std::int32_t other = facet_of[graph_.neighbours[k]];
          if (other < 0) continue;
          const std::size_t a = sets.root(f);
          const std::size_t b = sets.root(static_cast<std::size_t>(other));
          if (a != b) sets.join_roots(a, b);
        }
      }
    }
    std::vector<double> area(facets.size(), 0);
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const double own = facets[f].moments.area_m2;
      area[sets.root(f)] += own >= kPlaneLeast_m2 ? kVault_m2 : own;
    }
    std::vector<std::uint8_t> enough(facets.size(), 0);
    for (std::size_t f = 0; f < facets.size(); ++f) enough[f] = area[sets.root(f)] >= kVault_m2 ? 1 : 0;
    return enough;
  }

  void mark_beside(const std::vector<PlanarRegion>& regions, std::vector<std::uint8_t>& beside) const {
    for (const PlanarRegion& region : regions) {
      if (region.plane.pitch() < kBuiltSlope) continue;
      for (const std::uint32_t i : region.voxels) {
        for (std::uint32_t k = graph_.first[i]; k < graph_.first[i + 1]; ++k)
          beside[graph_.neighbours[k]] = 1;
      }
    }
  }

  const std::vector<SurfaceVoxel>& voxels_;
  const VoxelGraph& graph_;
  const std::vector<VoxelPatch>& patches_;
  double noise_m_;
  std::vector<std::uint8_t>& taken_;
};

}  // namespace

std::vector<PlanarRegion> find_facets(const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
                                      const std::vector<VoxelPatch>& patches,
                                      const std::vector<PlanarRegion>& planes, double noise_m,
                                      std::vector<std::uint8_t>& taken) {
  return FacetFinder(voxels, graph, patches, noise_m, taken).find(planes);
}

}  // namespace roomcut::slice

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/planes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "stages/slice/facets.h"
#include "stages/slice/merge_regions.h"
#include "stages/slice/outline.h"
#include "stages/slice/plane_side.h"
#include "stages/slice/region_kinds.h"

namespace roomcut::slice {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kScrap_m2 = 0.3;  ///< smaller regions are none
constexpr double kApart_m = 0.02, kTurned = 8 * kDegree;

SlopedPlane to_plane(const PlanarRegion& region, PlaneSide side, std::vector<Vec2> outline) {
  SlopedPlane plane;
  plane.gradient = region.plane.gradient();
  plane.c = region.plane.height({0, 0});
  plane.outline = std::move(outline);
  plane.area_m2 = region.moments.area_m2;
  plane.rms_m = region.plane.rms_m;
  plane.ceiling = side == PlaneSide::kCeiling;
  return plane;
}

/// What the survey's surfaces are made of, while it is found out.
class PlaneFinder {
 public:
  PlaneFinder(const HeightSurvey& survey, double noise_m)
      : survey_(survey), voxels_(survey.voxels), noise_m_(noise_m), taken_(voxels_.size(), 0) {}

  /// Whether anything slopes, seen without the level blocks, which most of a building's surface is.
  bool any_slope() {
    level_blocks(voxels_, noise_m_, taken_);
    look_closely();
    const std::vector<PlanarRegion> regions = grow();
    double sloped_m2 = 0;
    for (const PlanarRegion& region : regions) {
      if (slopes(region, voxels_, noise_m_)) sloped_m2 += region.moments.area_m2;
    }
    return sloped_m2 >= kPlaneLeast_m2;
  }

  SlopedSurfaces find() {
    taken_.assign(voxels_.size(), 0);
    look_closely();
    find_regions();
    const std::vector<PlanarRegion> facets =
        find_facets(voxels_, graph_, patches_, planes_, noise_m_, taken_);
    planes_.insert(planes_.end(), facets.begin(), facets.end());
    return result();
  }

 private:
  /// At the voxels that are free.
  void look_closely() {
    graph_ = voxel_graph(voxels_, taken_);
    patches_ = voxel_patches(voxels_, graph_, noise_m_, taken_);
  }
  double apart() const { return std::max(kApart_m, 3 * noise_m_); }
  std::vector<PlanarRegion> grow() {
    const RegionRules rules{noise_m_, apart(), kTurned, 0, kSteepestPlane};
    return grow_regions(voxels_, graph_, patches_, rules, kScrap_m2, taken_);
  }

  void find_regions() {
    std::vector<PlanarRegion> regions = grow();
    settle_borders(regions, voxels_, graph_, apart());
    merge_regions(regions, voxels_, noise_m_, kGentlestPlane);
    const std::vector<RegionKind> kinds = region_kinds(regions, voxels_, graph_, noise_m_);
    for (std::size_t r = 0; r < regions.size(); ++r) {
      if (kinds[r] == RegionKind::kPlane) {
        planes_.push_back(std::move(regions[r]));
      } else if (kinds[r] == RegionKind::kLevel) {
        levels_.push_back(std::move(regions[r]));
      } else {
        for (const std::uint32_t i : regions[r].voxels) taken_[i] = 0;  // perhaps a part of a facet
      }
    }
  }

  /// The planes, and behind them the levels.
  std::vector<PlanarRegion> with_levels() const {
    std::vector<PlanarRegion> all = planes_;
    all.insert(all.end(), levels_.begin(), levels_.end());
    return all;
  }
  void remove_clutter() {
    const std::vector<std::int32_t> region_of = regions_of(with_levels(), voxels_.size());
    std::erase_if(planes_, [&](const PlanarRegion& plane) {
      return side_of(plane, survey_, region_of) == PlaneSide::kClutter;
    });
  }

  SlopedSurfaces result() {
    remove_clutter();
    std::stable_sort(planes_.begin(), planes_.end(), [](const PlanarRegion& a, const PlanarRegion& b) {
      return a.moments.area_m2 > b.moments.area_m2;
    });
    const std::vector<PlanarRegion> all = with_levels();
    SlopedSurfaces found{{}, regions_of(all, voxels_.size())};
    const std::size_t planes = planes_.size();
    for (std::size_t k = 0; k < planes; ++k) {
      found.planes.push_back(to_plane(all[k], side_of(all[k], survey_, found.of_voxel),
                                      outline_of(k, all, voxels_, found.of_voxel)));
    }
    for (std::int32_t& plane : found.of_voxel) {
      if (plane >= static_cast<std::int32_t>(planes)) plane = SlopedSurfaces::kLevel;
    }
    return found;
  }

  const HeightSurvey& survey_;
  const std::vector<SurfaceVoxel>& voxels_;
  double noise_m_;
  std::vector<std::uint8_t> taken_;
  VoxelGraph graph_;
  std::vector<VoxelPatch> patches_;
  std::vector<PlanarRegion> planes_, levels_;
};

}  // namespace

SlopedSurfaces find_planes(const HeightSurvey& survey, double noise_m) {
  PlaneFinder finder(survey, noise_m);
  return finder.any_slope() ? finder.find() : SlopedSurfaces{};
}

}  // namespace roomcut::slice

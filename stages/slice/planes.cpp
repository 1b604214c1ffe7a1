// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/planes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "stages/slice/merge_regions.h"
#include "stages/slice/outline.h"
#include "stages/slice/plane_side.h"
#include "stages/slice/surface_graph.h"

namespace roomcut::slice {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kGentlest = 0.5 * kDegree, kSteepest = 68 * kDegree;
constexpr double kSmallest_m2 = 2, kNarrowest_m = 0.5;
constexpr double kScrap_m2 = 0.3;        ///< smaller regions are none
constexpr double kSteepestDrift = 0.04;  ///< rise per metre; no floor of a mobile scan drifts more
constexpr double kUneven = 0.015;        ///< of its rise
constexpr double kBuilt = 12 * kDegree;  ///< nothing that is meant to be level is so steep …
constexpr double kRough_m = 0.01;        ///< … and boards and plaster are uneven by so much
constexpr double kFacetFrom = 3 * kDegree;
constexpr double kApart_m = 0.02, kTurned = 8 * kDegree;
constexpr double kFacetApart_m = 0.06, kFacetTurned = 15 * kDegree, kFacetRms_m = 0.04;

enum class Kind : std::uint8_t { kLevel, kScrap, kBent, kPlane };

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

/// Rises by more than a level tolerates.
bool slopes(const PlanarRegion& region, const std::vector<SurfaceVoxel>& voxels, double noise_m) {
  const double pitch = region.plane.pitch();
  if (pitch < kGentlest || pitch > kSteepest) return false;
  const auto [low, high] = heights(region, voxels);
  return high - low > std::max(0.08, (pitch < kSteepestDrift ? 16 : 12) * noise_m);
}

bool is_wide(const PlanarRegion& region) {
  return region.moments.area_m2 >= kSmallest_m2 && region.plane.width_m >= kNarrowest_m;
}

/// Whether the points leave the plane by more than noise and a part of its rise: then it is a piece of
/// something bent, as the drifting floor of a mobile scan is.
bool is_bent(const PlanarRegion& region, const std::vector<SurfaceVoxel>& voxels, double noise_m) {
  const auto [low, high] = heights(region, voxels);
  const double uneven = kUneven * (high - low);
  const double most = region.plane.pitch() < kBuilt ? uneven : std::max(uneven, kRough_m);
  return region.plane.rms_m > std::hypot(1.1 * noise_m, most);
}

/// Takes the gentle planes out that go on smoothly into something bent: a surface drifts as a whole.
void remove_drift(const std::vector<PlanarRegion>& regions, const std::vector<SurfaceVoxel>& voxels,
                  const VoxelGraph& graph, std::vector<Kind>& kinds) {
  const std::vector<std::int32_t> region_of = regions_of(regions, voxels.size());
  const auto gentle = [&](std::size_t r) { return regions[r].plane.pitch() < kSteepestDrift; };
  DisjointSets surfaces(regions.size());
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (region_of[i] < 0 || !gentle(static_cast<std::size_t>(region_of[i]))) continue;
    const auto own = static_cast<std::size_t>(region_of[i]);
    if (kinds[own] == Kind::kLevel) continue;
    for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
      const std::int32_t beside = region_of[graph.neighbours[k]];
      if (beside < 0 || beside == region_of[i]) continue;
      const auto other = static_cast<std::size_t>(beside);
      if (!gentle(other) || kinds[other] == Kind::kLevel) continue;
      const std::size_t a = surfaces.root(own);
      const std::size_t b = surfaces.root(other);
      if (a != b) surfaces.join_roots(a, b);
    }
  }
  std::vector<std::uint8_t> bent(regions.size(), 0);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (gentle(r) && kinds[r] == Kind::kBent) bent[surfaces.root(r)] = 1;
  }
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (gentle(r) && bent[surfaces.root(r)] != 0) kinds[r] = Kind::kLevel;
  }
}

std::vector<Kind> kinds_of(const std::vector<PlanarRegion>& regions, const std::vector<SurfaceVoxel>& voxels,
                           double noise_m) {
  std::vector<Kind> kinds;
  kinds.reserve(regions.size());
  for (const PlanarRegion& region : regions) {
    const bool rises = slopes(region, voxels, noise_m);
    kinds.push_back(!rises                             ? Kind::kLevel
                    : !is_wide(region)                 ? Kind::kScrap
                    : is_bent(region, voxels, noise_m) ? Kind::kBent
                                                       : Kind::kPlane);
  }
  return kinds;
}

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
    return sloped_m2 >= kSmallest_m2;
  }

  SlopedSurfaces find() {
    taken_.assign(voxels_.size(), 0);
    look_closely();
    find_regions();
    find_facets();
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
    const RegionRules rules{noise_m_, apart(), kTurned, 0, kSteepest};
    return grow_regions(voxels_, graph_, patches_, rules, kScrap_m2, taken_);
  }

  void find_regions() {
    std::vector<PlanarRegion> regions = grow();
    settle_borders(regions, voxels_, graph_, apart());
    merge_regions(regions, voxels_, noise_m_, kGentlest);
    std::vector<Kind> kinds = kinds_of(regions, voxels_, noise_m_);
    remove_drift(regions, voxels_, graph_, kinds);
    for (std::size_t r = 0; r < regions.size(); ++r) {
      if (kinds[r] == Kind::kPlane) {
        planes_.push_back(std::move(regions[r]));
      } else if (kinds[r] == Kind::kLevel) {
        levels_.push_back(std::move(regions[r]));
      } else {
        for (const std::uint32_t i : regions[r].voxels) taken_[i] = 0;  // perhaps a part of a facet
      }
    }
  }

  /// Steep facets first. Gentle ones only beside them, at a vault's crown: alone they are drift.
  void find_facets() {
    std::vector<std::uint8_t> beside = grow_facets(kBuilt, std::vector<std::uint8_t>(voxels_.size(), 1));
    grow_facets(kFacetFrom, beside);
  }

  /// Adds the facets that touch voxels marked in `near`. Returns the voxels beside the planes.
  std::vector<std::uint8_t> grow_facets(double min_pitch, const std::vector<std::uint8_t>& near) {
    const RegionRules rules{noise_m_, std::max(kFacetApart_m, 3 * noise_m_), kFacetTurned, min_pitch,
                            kSteepest};
    for (PlanarRegion& facet : grow_regions(voxels_, graph_, patches_, rules, kSmallest_m2, taken_)) {
      const bool touches = std::any_of(facet.voxels.begin(), facet.voxels.end(),
                                       [&](std::uint32_t i) { return near[i] != 0; });
      if (touches && facet.plane.rms_m <= std::max(kFacetRms_m, 2 * noise_m_) && is_wide(facet) &&
          slopes(facet, voxels_, noise_m_)) {
        planes_.push_back(std::move(facet));
      } else {
        for (const std::uint32_t i : facet.voxels) taken_[i] = 0;
      }
    }
    std::vector<std::uint8_t> beside(voxels_.size(), 0);
    for (const PlanarRegion& plane : planes_) {
      if (plane.plane.pitch() < kBuilt) continue;
      for (const std::uint32_t i : plane.voxels) {
        for (std::uint32_t k = graph_.first[i]; k < graph_.first[i + 1]; ++k)
          beside[graph_.neighbours[k]] = 1;
      }
    }
    return beside;
  }

  SlopedSurfaces result() {
    std::erase_if(planes_,
                  [&](const PlanarRegion& plane) { return side_of(plane, survey_) == PlaneSide::kClutter; });
    std::stable_sort(planes_.begin(), planes_.end(), [](const PlanarRegion& a, const PlanarRegion& b) {
      return a.moments.area_m2 > b.moments.area_m2;
    });
    const std::size_t planes = planes_.size();
    planes_.insert(planes_.end(), levels_.begin(), levels_.end());
    SlopedSurfaces found{{}, regions_of(planes_, voxels_.size())};
    for (std::size_t k = 0; k < planes; ++k) {
      found.planes.push_back(to_plane(planes_[k], side_of(planes_[k], survey_),
                                      outline_of(k, planes_, voxels_, found.of_voxel)));
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

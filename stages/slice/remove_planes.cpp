// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "stages/slice/planes.h"

namespace roomcut::slice {
namespace {

/// Says whether a place lies on one of the planes; only where voxels near it do.
class OnPlanes {
 public:
  OnPlanes(const SlopedSurfaces& surfaces, const HeightSurvey& survey, double noise_m)
      : surfaces_(surfaces), survey_(survey), noise_m_(noise_m) {}

  /// For the middle of a square of that edge, whose heights the slope changes.
  bool contain(const Vec3& p, double edge_m) const {
    const VoxelSize& size = survey_.voxel;
    const CellKey key = size.at(p);
    bool level = false, found = false;
    // A steep plane leaves the middle of a wide square far above or below its voxels.
    const std::int32_t height = edge_m > size.plan_m ? 3 : 1;
    for_each_near(survey_.voxels, key, 1, height, [&](std::size_t j) {
      const std::int32_t plane = surfaces_.of_voxel[j];
      if (plane == SlopedSurfaces::kLevel && survey_.voxels[j].key == key) level = true;
      if (plane >= 0 && !found) found = near(surfaces_.planes[static_cast<std::size_t>(plane)], p, edge_m);
    });
    return found && !level;
  }

 private:
  bool near(const SlopedPlane& plane, const Vec3& p, double edge_m) const {
    const double most =
        std::max({0.03, 3 * noise_m_, 2 * plane.rms_m}) * std::sqrt(1 + plane.gradient.squaredNorm()) +
        0.5 * edge_m * plane.gradient.lpNorm<1>();
    return std::abs(p.z() - plane.height(p.head<2>())) <= most;
  }
  const SlopedSurfaces& surfaces_;
  const HeightSurvey& survey_;
  double noise_m_;
};

}  // namespace

void remove_planes(const SlopedSurfaces& surfaces, double noise_m, HeightSurvey& survey) {
  if (surfaces.planes.empty()) return;
  const OnPlanes planes(surfaces, survey, noise_m);
  const double raster = survey.raster_m;
  std::erase_if(survey.patches, [&](const SurfacePatch& patch) {
    return planes.contain({(patch.ix + 0.5) * raster, (patch.iy + 0.5) * raster, patch.z}, raster);
  });
  for (UprightBlock& block : survey.upright) {
    if (block.sloped_m2 <= 0) continue;
    const Vec3 middle((block.ix + 0.5) * kUprightPlan, (block.iy + 0.5) * kUprightPlan,
                      (block.iz + 0.5) * kUprightHeight);
    if (!planes.contain(middle, kUprightPlan)) continue;
    block.area_m2 = std::max(0.0, block.area_m2 - block.sloped_m2);
    block.sloped_m2 = 0;
  }
}

}  // namespace roomcut::slice

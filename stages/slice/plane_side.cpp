// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/plane_side.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "stages/slice/fixed_point.h"

namespace roomcut::slice {
namespace {

constexpr double kSlab_m = 0.6;    ///< thicker ones are rooms
constexpr double kOwn_m = 0.12;    ///< nearer surfaces are the region's own
constexpr double kSurface = 0.25;  ///< share of a voxel's plan that makes a surface, not a scrap
constexpr double kNothing = std::numeric_limits<double>::infinity();

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Distances to the next surface above and below, medians over the region's columns.
std::pair<double, double> next_surfaces(const PlanarRegion& region, const HeightSurvey& survey) {
  std::vector<double> above, below;
  const double least = kSurface * survey.voxel.plan_m * survey.voxel.plan_m;
  for (const std::uint32_t i : region.voxels) {
    const SurfaceVoxel& own = survey.voxels[i];
    double up = kNothing, down = kNothing;
    for_each_near(survey.voxels, own.key, 0, std::numeric_limits<std::int32_t>::max() / 2,
                  [&](std::size_t j) {
                    const Moments& other = survey.voxels[j].moments;
                    if (other.area_m2 < least) return;
                    const Vec3 p = other.mean();
                    const double over = p.z() - region.plane.height(p.head<2>());
                    if (over > kOwn_m) up = std::min(up, over);
                    if (over < -kOwn_m) down = std::min(down, -over);
                  });
    above.push_back(up);
    below.push_back(down);
  }
  return {median(above), median(below)};
}

/// Upright surface in the half metre over and under the region.
struct Walls {
  double standing_m2 = 0, hanging_m2 = 0;
  double share = 0;  ///< of what stands and hangs where walls are all around it
};

Walls walls_beside(const PlanarRegion& region, const HeightSurvey& survey) {
  std::set<std::pair<std::int32_t, std::int32_t>> plan;
  for (const std::uint32_t i : region.voxels) {
    const Vec3 p = survey.voxels[i].moments.mean();
    plan.emplace(floor_to_int(p.x() / kUprightPlan), floor_to_int(p.y() / kUprightPlan));
  }
  // In a block the surface itself lies so much higher and lower than in the middle.
  const double rise = 0.5 * kUprightPlan * region.plane.gradient().lpNorm<1>();
  constexpr double kBeside_m = 0.1, kReach_m = 0.5;
  Walls walls;
  for (const UprightBlock& block : survey.upright) {
    if (!plan.contains({block.ix, block.iy})) continue;
    const Vec2 middle((block.ix + 0.5) * kUprightPlan, (block.iy + 0.5) * kUprightPlan);
    const double over = (block.iz + 0.5) * kUprightHeight - region.plane.height(middle);
    const double beyond = std::abs(over) - rise - kBeside_m;
    if (beyond < 0 || beyond > kReach_m) continue;
    (over > 0 ? walls.standing_m2 : walls.hanging_m2) += block.area_m2 - block.sloped_m2;
  }
  const double round_m = 4 * std::sqrt(region.moments.area_m2);
  walls.share = std::max(walls.standing_m2, walls.hanging_m2) / (kReach_m * round_m);
  return walls;
}

/// Whether three of its voxels are near those of other regions: a flight of stairs ends at landings.
bool touches_another(const PlanarRegion& region, const HeightSurvey& survey,
                     const std::vector<std::int32_t>& region_of) {
  constexpr int kEnough = 3;
  const std::int32_t own = region_of[region.voxels.front()];
  int touching = 0;
  for (const std::uint32_t i : region.voxels) {
    bool touches = false;
    for_each_near(survey.voxels, survey.voxels[i].key, 1, 1,
                  [&](std::size_t j) { touches |= region_of[j] >= 0 && region_of[j] != own; });
    touching += touches ? 1 : 0;
  }
  return touching >= kEnough;
}

}  // namespace

PlaneSide side_of(const PlanarRegion& region, const HeightSurvey& survey,
                  const std::vector<std::int32_t>& region_of) {
  constexpr double kWalled = 0.1;
  const auto [up, down] = next_surfaces(region, survey);
  const bool open_up = up == kNothing;
  const bool open_down = down == kNothing;
  const auto ceiling_if = [](bool ceiling) { return ceiling ? PlaneSide::kCeiling : PlaneSide::kFloor; };
  if (open_up && !open_down) return ceiling_if(down >= kSlab_m);
  if (open_down && !open_up) return ceiling_if(up < kSlab_m);
  if (!open_up && (up < kSlab_m) != (down < kSlab_m)) return ceiling_if(up < kSlab_m);
  const Walls walls = walls_beside(region, survey);
  const bool hovers = !open_up && up >= kSlab_m && walls.share < kWalled;
  if (hovers && !touches_another(region, survey, region_of)) return PlaneSide::kClutter;
  return ceiling_if(walls.hanging_m2 >= walls.standing_m2);
}

}  // namespace roomcut::slice

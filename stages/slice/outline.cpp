// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/outline.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "common/geometry/convex_hull.h"

namespace roomcut::slice {
namespace {

void add_corners(const Moments& moments, std::vector<Vec2>& corners) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      Eigen::Matrix2d(moments.covariance().topLeftCorner<2, 2>()));
  const Vec2 middle = moments.mean().head<2>();
  const double half = std::sqrt(3.0);  // of a side, in standard deviations
  const Vec2 a = half * std::sqrt(std::max(0.0, axes.eigenvalues()[0])) * axes.eigenvectors().col(0);
  const Vec2 b = half * std::sqrt(std::max(0.0, axes.eigenvalues()[1])) * axes.eigenvectors().col(1);
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) corners.emplace_back(middle + s * a + t * b);
  }
}

constexpr std::int32_t kPlanReach = 2, kHeightReach = 3;  ///< voxels
constexpr double kFarthest_m = 0.45;                      ///< along the slope

/// The other regions near one voxel.
std::set<std::int32_t> beside(std::size_t region, std::uint32_t voxel,
                              const std::vector<SurfaceVoxel>& voxels,
                              const std::vector<std::int32_t>& region_of) {
  std::set<std::int32_t> others;
  for_each_near(voxels, voxels[voxel].key, kPlanReach, kHeightReach, [&](std::size_t j) {
    if (region_of[j] >= 0 && region_of[j] != static_cast<std::int32_t>(region)) others.insert(region_of[j]);
  });
  return others;
}

/// The way in plan from p to where a plane meets the nearest of others uphill (or downhill); (0, 0) when none
/// is near.
Vec2 way_to_next(const SpacePlane& own, const std::vector<const SpacePlane*>& others, const Vec2& p,
                 bool uphill) {
  constexpr double kLeastTurn = 0.02;  // of gradients: where planes nearly agree they meet anywhere
  Vec2 shortest(0, 0);
  double least = kFarthest_m;
  for (const SpacePlane* other : others) {
    const Vec2 turn = own.gradient() - other->gradient();
    if (turn.norm() < kLeastTurn) continue;
    const Vec2 way = -(own.height(p) - other->height(p)) / turn.squaredNorm() * turn;
    const double length = std::hypot(way.norm(), own.gradient().dot(way));
    if ((own.gradient().dot(way) > 0) != uphill || length >= least) continue;
    least = length;
    shortest = way;
  }
  return shortest;
}

/// Whether a plane meets another one between two places.
bool meets_between(const SpacePlane& own, const SpacePlane& other, const Vec2& p, const Vec2& q) {
  return (own.height(p) > other.height(p)) != (own.height(q) > other.height(q));
}

/// Moves the corners [first, end) that lie beyond another plane back to it, and adds those places of the next
/// planes that are near.
void end_at(const SpacePlane& own, const std::vector<const SpacePlane*>& others, const Vec2& middle,
            std::size_t first, std::vector<Vec2>& corners) {
  const std::size_t end = corners.size();
  for (std::size_t i = first; i < end; ++i) {
    const Vec2 corner = corners[i];
    for (const bool uphill : {false, true}) {
      const Vec2 way = way_to_next(own, others, corner, uphill);
      if (way.isZero()) continue;
      const bool beyond = std::any_of(others.begin(), others.end(), [&](const SpacePlane* other) {
        return meets_between(own, *other, middle, corner);
      });
      if (beyond) {
        corners[i] = corner + way;
      } else {
        corners.emplace_back(corner + way);
      }
    }
  }
}

}  // namespace

std::vector<Vec2> outline_of(std::size_t region, const std::vector<PlanarRegion>& regions,
                             const std::vector<SurfaceVoxel>& voxels,
                             const std::vector<std::int32_t>& region_of) {
  std::vector<Vec2> corners;
  for (const std::uint32_t i : regions[region].voxels) {
    const std::size_t first = corners.size();
    add_corners(voxels[i].moments, corners);
    std::vector<const SpacePlane*> others;
    for (const std::int32_t other : beside(region, i, voxels, region_of)) {
      others.push_back(&regions[static_cast<std::size_t>(other)].plane);
    }
    end_at(regions[region].plane, others, voxels[i].moments.mean().head<2>(), first, corners);
  }
  return convex_hull(std::move(corners));
}

}  // namespace roomcut::slice

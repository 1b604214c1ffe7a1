// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/furniture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace roomcut::slice {

namespace {

constexpr double kLargest_m2 = 12, kWidest_m = 1.6;
constexpr double kLowest_m = 0.25, kHighest_m = 1.3;  ///< above the floor
constexpr double kOverFloor = 0.25;                   ///< share of the surface under which the floor is seen
constexpr double kOpen = 0.4;                         ///< share of the border beside which the floor goes on
constexpr double kBeside_m = 0.35;
constexpr double kWalled = 0.8;  ///< share of a room's border; the rest are doors
/// A wall goes on where furniture has ended, backs and shelves too.
constexpr double kWallFrom_m = 1.0, kWallTo_m = 1.8;
constexpr double kWallReach_m = 0.25;  ///< half a plan cell of the survey
/// A quarter of a wall through a plan cell.
constexpr double kWallArea_m2 = 0.25 * kUprightPlan * (kWallTo_m - kWallFrom_m);

/// Upright area in one plan cell between two heights.
double upright_in(const std::vector<UprightBlock>& upright, std::int32_t ix, std::int32_t iy, double lo,
                  double hi) {
  const auto key = [](const UprightBlock& b) { return std::tuple(b.iy, b.ix, b.iz); };
  const auto first = static_cast<std::int32_t>(std::floor(lo / kUprightHeight));
  const auto from =
      std::lower_bound(upright.begin(), upright.end(), std::tuple(iy, ix, first),
                       [&](const UprightBlock& b, const auto& wanted) { return key(b) < wanted; });
  double area = 0;
  for (auto b = from; b != upright.end() && b->ix == ix && b->iy == iy && b->iz * kUprightHeight < hi; ++b) {
    area += b->area_m2;
  }
  return area;
}

bool wall_rises(const HeightSurvey& survey, const SurfaceCell& cell) {
  const auto plan = [&](std::int32_t i, int side) {
    const double place = (i + 0.5) * survey.raster_m + side * kWallReach_m;
    return static_cast<std::int32_t>(std::floor(place / kUprightPlan));
  };
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (upright_in(survey.upright, plan(cell.ix, dx), plan(cell.iy, dy), cell.z + kWallFrom_m,
                     cell.z + kWallTo_m) >= kWallArea_m2) {
        return true;
      }
    }
  }
  return false;
}

double share(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
}

double mean_height(const SurfaceComponent& surface) {
  double z = 0;
  for (const SurfaceCell& cell : surface.cells) {
    z += cell.z / static_cast<double>(surface.cells.size());
  }
  return z;
}

}  // namespace

bool is_furniture(const SurfaceComponent& surface, const Level& floor, const CellIndex& all,
                  const HeightSurvey& survey) {
  const double z = mean_height(surface);
  if (z < floor.z + kLowest_m || z > floor.z + kHighest_m) {
    return false;
  }
  const CellIndex own(surface.cells);
  const auto radius = std::max(2, static_cast<std::int32_t>(std::ceil(kBeside_m / survey.raster_m)));
  std::size_t border = 0, open = 0, walled = 0, over_floor = 0;
  for (const SurfaceCell& cell : surface.cells) {
    over_floor += all.any_near(cell.ix, cell.iy, 0, floor.lo, floor.hi) ? 1 : 0;
    const std::int32_t step = reach_of(cell, survey.raster_m);
    const auto inside = [&](std::int32_t dx, std::int32_t dy) {
      return own.any_near(cell.ix + dx * step, cell.iy + dy * step, step - 1, -1e9, 1e9);
    };
    if (inside(1, 0) && inside(-1, 0) && inside(0, 1) && inside(0, -1)) {
      continue;
    }
    ++border;
    open += all.any_near(cell.ix, cell.iy, radius, floor.lo, floor.hi) ? 1 : 0;
    walled += wall_rises(survey, cell) ? 1 : 0;
  }
  if (share(over_floor, surface.cells.size()) >= kOverFloor) {
    return true;
  }
  const double width =
      2 * surface.area_m2 / (static_cast<double>(std::max<std::size_t>(1, border)) * survey.raster_m);
  // A thin wall hides nothing of the floor of the next room: a room of a raised floor looks open, too.
  const bool small = surface.area_m2 < kLargest_m2 && share(walled, border) < kWalled;
  return (small || width < kWidest_m) && share(open, border) >= kOpen;
}

}  // namespace roomcut::slice

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "stages/ingest/normal_hint.h"
#include "stages/ingest/plane.h"

namespace roomcut::ingest {

namespace {

constexpr int kLast = fixed_grid::kLevels - 1;
constexpr std::uint32_t kFewest = 6;      // points for a plane and an idea of its scatter
constexpr std::uint32_t kMost = 150'000;  // the moments stay exact at every level (spread_of)
constexpr std::uint32_t kParentHas =
    48;  // a level is fine enough when its parent's neighbourhood holds so many:
         // four times the 12 that a neighbourhood should hold. Asking the parent,
         // not the count itself, keeps the areas free of a selection bias
constexpr std::uint32_t kWellFilled = 20;     // points for a noise estimate
constexpr float kFlat_m = 0.02F;              // scatter of a plane that shows how it leans
constexpr double kClearPlane = 0.15;          // lambda0 / lambda1 for a noise estimate
constexpr std::uint32_t kFewestInLayer = 12;  // points for a plane in a layer of voxels
constexpr double kLineShare = 0.01;  // lambda1 below this share of the neighbourhood's edge squared: a line
constexpr double kLargestTilt =
    0.0027;  // (3 degrees)^2: a less certain direction is asked from a coarser voxel
double whole_area(const Plane& plane, SurfaceClass surface, const Spread& spread, double units_per_edge,
                  double edge_m) {
  const std::array<double, 3>& n = plane.normal;
  if (surface == SurfaceClass::kWall) {
    const double horizontal = std::sqrt(n[0] * n[0] + n[1] * n[1]);
    const double d = (n[0] * spread.mean[0] + n[1] * spread.mean[1]) / (horizontal * units_per_edge);
    return 3 * chord_of_square(n[0] / horizontal, n[1] / horizontal, d) * edge_m * edge_m / horizontal;
  }
  const double steepest = std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])});
  return 9 * edge_m * edge_m / steepest;
}

int viewing_axis(const std::array<double, 3>& n) {
  const double x = std::abs(n[0]);
  const double y = std::abs(n[1]);
  const double z = std::abs(n[2]);
  return z >= std::max(x, y) ? 2 : (y >= x ? 1 : 0);
}

/// Where the points leave the plane or its direction in doubt, as noise and small numbers do, the next
/// coarser voxel decides, if it sees a plane more clearly. A plane that chance may have made and that it does
/// not see is none.
template <class SurfaceAt>
void settle(VoxelSurface& chosen, int& level, const SurfaceAt& surface_at) {
  while (level < kLast && (chosen.undecided || chosen.tilt_variance > kLargestTilt)) {
    const VoxelSurface coarser = surface_at(level + 1);
    if (coarser.surface == SurfaceClass::kNone || coarser.tilt_variance >= chosen.tilt_variance) {
      if (chosen.undecided) {
        chosen.surface = SurfaceClass::kNone;
        chosen.azimuth = 0;
        chosen.noise = 0;
      }
      return;
    }
    chosen = coarser;
    ++level;
  }
}

/// Area per point where a neighbourhood has holes. Holes that a coarser voxel does not see are gaps between
/// scan lines: then its area counts, or better that of the next one, since three lines in three cells are
/// more than a fair share. Holes at every level are the border of a surface.
template <class SurfaceAt>
float area_over_gaps(const VoxelSurface& chosen, int first, const SurfaceAt& surface_at) {
  float area = chosen.area;
  int whole = 0;
  for (int level = first; level <= kLast && whole < 2; ++level) {
    const VoxelSurface surface = surface_at(level);
    if (surface.surface == chosen.surface && surface.whole) {
      area = surface.area;
      ++whole;
    } else if (whole > 0) {
      break;
    }
  }
  return area;
}

/// Calls visit(ix, iy, first voxel, last + 1) for each column of the tile itself that has any.
template <class Visit>
void for_own_columns(const VoxelLevel& level, Visit&& visit) {
  for (int iy = level.halo(); iy < level.columns - level.halo(); ++iy) {
    for (int ix = level.halo(); ix < level.columns - level.halo(); ++ix) {
      const std::size_t column = level.column(ix, iy);
      if (level.begin[column] < level.begin[column + 1]) {
        visit(ix, iy, level.begin[column], level.begin[column + 1]);
      }
    }
  }
}

/// The level whose neighbourhoods show best how planes lean: the coarsest, 1.2 m wide, where one scattered
/// point is a matter of minutes of arc, unless they hold too many points there.
int leaning_level(const TileGrid& grid) {
  int level = kLast;
  const std::size_t points = grid.points().size();
  while (level > 1 && 9 * points > kMost / 2 * std::max<std::size_t>(1, grid.level(level).size())) {
    --level;
  }
  return level;
}

void add_lean(const VoxelSurface& surface, LeanSums& sums) {
  if (surface.noise <= 0 || surface.noise > kFlat_m) {
    return;
  }
  if (surface.surface == SurfaceClass::kHorizontal) {
    sums.add_level(surface.lean);
  } else if (surface.surface == SurfaceClass::kWall) {
    sums.add_wall(surface.lean, azimuth_of(surface.azimuth));
  }
}

NeighbourSum accumulate(const VoxelLevel& level, std::uint16_t z, Neighbourhood& around) {
  MomentSum moments;
  VoxelMask mask = 0;
  const Moments* const first = level.moments.data();
  around.visit(z, [&](std::uint32_t voxel, int bit) {
    moments.add(first[voxel]);
    mask |= VoxelMask{1} << bit;
  });
  return {moments.total(), mask};
}

/// The same by height: the layer of voxels below, the own one, the one above.
std::array<NeighbourSum, 3> accumulate_layers(const VoxelLevel& level, std::uint16_t z,
                                              Neighbourhood& around) {
  std::array<MomentSum, 3> moments;
  std::array<NeighbourSum, 3> layers;
  const Moments* const first = level.moments.data();
  around.visit(z, [&](std::uint32_t voxel, int bit) {
    const auto layer = static_cast<std::size_t>(bit % 3);
    moments[layer].add(first[voxel]);
    layers[layer].mask |= VoxelMask{1} << bit;
  });
  for (std::size_t k = 0; k < layers.size(); ++k) layers[k].moments = moments[k].total();
  return layers;
}

/// Whether a layer beside the own one is filled as the face of a slab fills it; a wall fills three cells.
bool may_hold_slab(VoxelMask mask) {
  constexpr VoxelMask kBelow = 0b001'001'001'001'001'001'001'001'001;
  constexpr int kFewestCells = 4;
  return std::max(std::popcount(mask & kBelow), std::popcount(mask >> 2 & kBelow)) >= kFewestCells;
}

NeighbourSum together(const NeighbourSum& a, const NeighbourSum& b) {
  MomentSum sum;
  sum.add(a.moments);
  sum.add(b.moments);
  return {sum.total(), a.mask | b.mask};
}

/// Whether points seen from above leave no cell of the nine empty but by chance.
bool is_whole_from_above(const NeighbourSum& sum) {
  constexpr int kUp = 2;
  return covered_cells(sum.moments.points(), std::popcount(projected(sum.mask, kUp))).whole;
}

/// Standard deviation of the points off their best plane [units].
double scatter_of(const NeighbourSum& sum, const std::array<std::uint32_t, 3>& centre) {
  return std::sqrt(plane_of(spread_of(sum.moments, centre)).lambda0);
}

}  // namespace

VoxelSurface surface_of(const NeighbourSum& sum, const std::array<std::uint32_t, 3>& centre,
                        double voxel_edge_m, double unit_m, const IngestParams& params) {
  VoxelSurface result;
  const std::uint32_t points = sum.moments.points();
  const double n = points;
  result.area = static_cast<float>(std::popcount(sum.mask) * voxel_edge_m * voxel_edge_m / n);
  if (points < kFewest || points > kMost) {
    return result;
  }
  const double edge = voxel_edge_m / unit_m;
  const Spread spread = spread_of(sum.moments, centre);
  const Plane plane = plane_of(spread);
  result.resolved = plane.lambda1 > kLineShare * 9 * edge * edge;
  if (!result.resolved) {
    return result;
  }
  const double ratio = plane.lambda0 / plane.lambda1;
  result.tilt_variance = static_cast<float>(ratio / n);
  const double from_limit = ratio / params.planar_ratio - 1;
  result.undecided = from_limit * from_limit * n < 4;  // within two standard deviations, 1 / sqrt(n) each
  if (ratio >= params.planar_ratio) {
    return result;
  }
  result.surface = class_of_slope(std::abs(plane.normal[2]), params);
  if (result.surface == SurfaceClass::kSloped && ratio >= kClearPlane) {
    // A floor and a wall in one neighbourhood: seen as a plane between the two, its ratio is .16 … .28.
    result.surface = SurfaceClass::kNone;
    return result;
  }
  if (result.surface == SurfaceClass::kWall) {
    result.azimuth = azimuth_step(plane.normal[0], plane.normal[1]);
    result.lean = lean_of_wall(plane.normal);
  } else if (result.surface == SurfaceClass::kHorizontal) {
    result.lean = lean_of_level(plane.normal);
  }
  const int filled = std::popcount(projected(sum.mask, viewing_axis(plane.normal)));
  const Covered covered = covered_cells(points, filled);
  result.whole = covered.whole;
  result.area = static_cast<float>(whole_area(plane, result.surface, spread, edge, voxel_edge_m) *
                                   covered.cells / (9 * n));
  if (points >= kWellFilled && ratio < kClearPlane) {
    const double sigma = std::sqrt(plane.lambda0 * n / (n - 3)) * unit_m;  // three parameters were fitted
    result.noise = static_cast<float>(std::max(sigma, 1e-6));              // exact planes count as well
  }
  return result;
}

/// The surface of a coarse voxel. A neighbourhood that holds a ceiling and the floor above it, both sides of
/// a slab, is no plane; its own layer of voxels, with the next one if the surface lies in both, is one then,
/// and so is the rest.
VoxelSurface SurfaceFinder::fit_coarse(const TileGrid& grid, const UnitScale& scale, int level,
                                       std::uint32_t voxel, int ix, int iy) const {
  const VoxelLevel& voxels = grid.level(level);
  const std::uint16_t z = voxels.z[voxel];
  const std::array<std::uint32_t, 3> centre = grid.centre(level, ix, iy, z);
  const auto fit = [&](const NeighbourSum& sum) {
    return surface_of(sum, centre, scale.voxel_edge_m() * (1 << level), scale.unit_m(), params_);
  };
  Neighbourhood around(voxels, ix, iy);
  const NeighbourSum sum = accumulate(voxels, z, around);
  const VoxelSurface all = fit(sum);
  if (!all.resolved || all.surface != SurfaceClass::kNone || sum.moments.points() < 2 * kFewestInLayer ||
      !may_hold_slab(sum.mask)) {
    return all;
  }
  Neighbourhood again(voxels, ix, iy);
  const auto [below, own, above] = accumulate_layers(voxels, z, again);
  const auto is_level = [&](const NeighbourSum& face, const VoxelSurface& surface) {
    return surface.surface == SurfaceClass::kHorizontal &&
           scatter_of(face, centre) * scale.unit_m() < kFlat_m;
  };
  VoxelSurface best = all;
  std::uint32_t most = kFewestInLayer - 1;
  const auto try_slab = [&](const NeighbourSum& face, const NeighbourSum& other) {
    if (face.moments.points() <= most || !is_whole_from_above(face) || !is_whole_from_above(other)) return;
    const VoxelSurface surface = fit(face);
    if (is_level(face, surface) && is_level(other, fit(other))) {
      best = surface;
      most = face.moments.points();
    }
  };
  try_slab(own, above);
  try_slab(own, below);
  try_slab(together(below, own), above);
  try_slab(together(own, above), below);
  return best;
}

const VoxelSurface& SurfaceFinder::at_coarse(const TileGrid& grid, const UnitScale& scale, int level,
                                             std::uint32_t voxel, int ix, int iy) {
  Cached& cached = cache_[static_cast<std::size_t>(level)][voxel];
  if (!cached.known) {
    cached = {fit_coarse(grid, scale, level, voxel, ix, iy), true};
  }
  return cached.surface;
}

void SurfaceFinder::survey(const TileGrid& grid, const UnitScale& scale, int level) {
  const VoxelLevel& voxels = grid.level(level);
  std::vector<std::uint32_t>& counts = counts_[static_cast<std::size_t>(level)];
  std::vector<Cached>& cache = cache_[static_cast<std::size_t>(level)];
  counts.assign(voxels.size(), 0);
  cache.assign(voxels.size(), {});
  const auto parent_is_full = [&](std::uint32_t voxel) {
    return level == kLast || counts_[static_cast<std::size_t>(level) + 1][voxels.parent[voxel]] >= kParentHas;
  };
  for_own_columns(voxels, [&](int ix, int iy, std::uint32_t first, std::uint32_t last) {
    Neighbourhood around(voxels, ix, iy);
    for (std::uint32_t voxel = first; voxel < last; ++voxel) {
      std::uint32_t count = 0;
      around.visit(voxels.z[voxel], [&](std::uint32_t other, int) { count += voxels.points[other]; });
      counts[voxel] = count;
      if (count < kParentHas && parent_is_full(voxel)) {
        cache[voxel] = {fit_coarse(grid, scale, level, voxel, ix, iy), true};
      }
    }
  });
}

VoxelSurface SurfaceFinder::choose(const TileGrid& grid, const UnitScale& scale, std::uint32_t voxel, int ix,
                                   int iy, Neighbourhood& around) {
  std::array<std::uint32_t, fixed_grid::kLevels> ancestor{voxel};
  for (int i = 0; i < kLast; ++i) {
    const auto k = static_cast<std::size_t>(i);
    ancestor[k + 1] = grid.level(i).parent[ancestor[k]];
  }
  const auto surface_at = [&](int level) {
    if (level > 0) {
      return at_coarse(grid, scale, level, ancestor[static_cast<std::size_t>(level)], ix >> level,
                       iy >> level);
    }
    const NeighbourSum sum = accumulate(grid.level(0), grid.level(0).z[voxel], around);
    return surface_of(sum, grid.centre(0, ix, iy, grid.level(0).z[voxel]), scale.voxel_edge_m(),
                      scale.unit_m(), params_);
  };
  int level = 0;
  while (level < kLast) {
    const auto above = static_cast<std::size_t>(level) + 1;
    if (counts_[above][ancestor[above]] >= kParentHas) {
      break;
    }
    ++level;
  }
  const int expected = level;
  VoxelSurface chosen = surface_at(level);
  while (!chosen.resolved && level < kLast) {
    chosen = surface_at(++level);
  }
  const bool on_lines = level > expected;  // finer neighbourhoods saw single scan lines
  settle(chosen, level, surface_at);
  if (chosen.surface != SurfaceClass::kNone && (on_lines || !chosen.whole)) {
    chosen.area = area_over_gaps(chosen, chosen.whole ? level : level + 1, surface_at);
  }
  return chosen;
}

const std::vector<VoxelSurface>& SurfaceFinder::find(const TileGrid& grid, const UnitScale& scale,
                                                     SurfaceEstimates& estimates) {
  for (int level = kLast; level > 0; --level) {
    survey(grid, scale, level);
  }
  const VoxelLevel& finest = grid.level(0);
  result_.assign(finest.size(), {});
  for_own_columns(finest, [&](int ix, int iy, std::uint32_t first, std::uint32_t last) {
    Neighbourhood around(finest, ix, iy);
    for (std::uint32_t voxel = first; voxel < last; ++voxel) {
      result_[voxel] = choose(grid, scale, voxel, ix, iy, around);
      estimates.area.add(result_[voxel].area, finest.moments[voxel].points());
      if (result_[voxel].noise > 0) {
        estimates.noise.add(result_[voxel].noise);
      }
    }
  });
  const int coarse = leaning_level(grid);
  const VoxelLevel& voxels = grid.level(coarse);
  for_own_columns(voxels, [&](int ix, int iy, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t voxel = first; voxel < last; ++voxel) {
      add_lean(at_coarse(grid, scale, coarse, voxel, ix, iy), estimates.lean);
    }
  });
  return result_;
}

}  // namespace roomcut::ingest

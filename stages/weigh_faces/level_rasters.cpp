// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/level_rasters.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace roomcut::weigh_faces {

LevelRasters::LevelRasters(const CellComplex& complex, const Tolerances& tolerances)
    : complex_(complex),
      tolerances_(tolerances),
      faces_(complex, tolerances.bin, tolerances.core_margin),
      on_(complex.levels.size() * faces_.pieces()),
      sloped_(complex.levels.size() * faces_.pieces()),
      slope_(complex.layers() * faces_.pieces()),
      over_(complex.levels.size() * faces_.grid().size()),
      under_(complex.levels.size() * faces_.grid().size()) {}

void LevelRasters::add_bin(SparseCounts& counts, std::size_t level, const Vec2& p) {
  const PlanGrid& grid = faces_.grid();
  const int ix = grid.column(p.x());
  const int iy = grid.row(p.y());
  if (grid.contains(ix, iy)) {
    counts.add(level * grid.size() + grid.index(ix, iy));
  }
}

LevelRasters::Plan LevelRasters::measure_plan() const {
  Plan plan;
  plan.bin_of_piece.reserve(faces_.pieces());
  plan.bin_area.assign(faces_.grid().size(), 0.0F);
  plan.face_area.assign(complex_.faces(), 0.0);
  for (std::size_t bin = 0; bin < plan.bin_area.size(); ++bin) {
    for (std::size_t i = faces_.first(bin); i < faces_.first(bin + 1); ++i) {
      const FaceRaster::Piece& piece = faces_.piece(i);
      plan.bin_of_piece.push_back(static_cast<std::uint32_t>(bin));
      plan.bin_area[bin] += piece.area;
      plan.face_area[static_cast<std::size_t>(piece.face)] += piece.area;
    }
  }
  plan.area_table = AreaTable(plan.bin_area, faces_.grid().nx, faces_.grid().ny);
  return plan;
}

LevelRasters::Occupied LevelRasters::occupied_bins(const Plan& plan) const {
  Occupied occupied(complex_.levels.size());
  tbb::parallel_for(std::size_t{0}, occupied.size(), [&](std::size_t level) {
    occupied[level].assign(faces_.grid().size(), 0);
    const std::size_t base = level * faces_.pieces();
    const auto occupy = [&](std::size_t i, std::uint32_t /*count*/) {
      occupied[level][plan.bin_of_piece[i - base]] = 1;
    };
    on_.for_each(base, base + faces_.pieces(), occupy);
    if (!complex_.planes.empty()) {
      sloped_.for_each(base, base + faces_.pieces(), occupy);
    }
  });
  return occupied;
}

void LevelRasters::add_gap(std::size_t level, std::size_t bin, const Occupied& occupied,
                           LevelSides& sides) const {
  constexpr double kTall = 1.0;     // [m] room for a person to stoop: a room, not a plenum
  constexpr double kShort = 0.7;    // [m] at most a thick slab
  constexpr double kUnseen = 0.25;  // what a side counts on which nothing was seen at all
  constexpr double kNothing = 1e9;
  double above = kNothing;
  for (std::size_t l = level + 1; l < occupied.size() && above == kNothing; ++l) {
    above = occupied[l][bin] != 0 ? complex_.levels[l] - complex_.levels[level] : kNothing;
  }
  double below = kNothing;
  for (std::size_t l = level; l-- > 0 && below == kNothing;) {
    below = occupied[l][bin] != 0 ? complex_.levels[level] - complex_.levels[l] : kNothing;
  }
  const auto open = [](double gap) { return gap > kTall && gap < kNothing; };
  const auto closed = [](double gap) { return gap < kShort ? 1.0 : gap == kNothing ? kUnseen : 0.0; };
  sides.open_over += open(above) ? closed(below) : 0;
  sides.open_under += open(below) ? closed(above) : 0;
}

std::vector<LevelSides> LevelRasters::sides_of_faces(std::size_t level, const Occupied& occupied) const {
  const PlanGrid& grid = faces_.grid();
  std::vector<LevelSides> sides(complex_.faces());
  const auto near_surface = [&](int ix,
                                int iy) {  // the rim of a surface counts too: there a wall stands on it
    for (int y = std::max(0, iy - 1); y <= std::min(grid.ny - 1, iy + 1); ++y) {
      for (int x = std::max(0, ix - 1); x <= std::min(grid.nx - 1, ix + 1); ++x) {
        if (occupied[level][grid.index(x, y)] != 0) {
          return true;
        }
      }
    }
    return false;
  };
  const auto any_in = [&](const SparseCounts& counts) {
    const std::size_t base = level * grid.size();
    std::vector<std::uint8_t> any(grid.size(), 0);
    counts.for_each(base, base + grid.size(),
                    [&](std::size_t i, std::uint32_t /*count*/) { any[i - base] = 1; });
    return any;
  };
  const std::vector<std::uint8_t> over = any_in(over_);
  const std::vector<std::uint8_t> under = any_in(under_);
  std::size_t bin = 0;
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix, ++bin) {
      LevelSides here;
      here.over = over[bin];
      here.under = under[bin];
      const bool on = occupied[level][bin] != 0;
      if (!on && (here.over + here.under == 0 || !near_surface(ix, iy))) {
        continue;
      }
      if (on) {
        add_gap(level, bin, occupied, here);
      }
      for (std::size_t i = faces_.first(bin); i < faces_.first(bin + 1); ++i) {
        sides[static_cast<std::size_t>(faces_.piece(i).face)] += here;
      }
    }
  }
  return sides;
}

std::vector<float> LevelRasters::covered_share(const Plan& plan, std::size_t base, const SparseCounts& counts,
                                               const SparseCounts* more) const {
  std::vector<float> share(complex_.faces(), 0.0F);
  std::vector<std::uint8_t> seen(faces_.pieces(), 0);
  std::vector<float> points(plan.bin_area.size(), 0.0F);
  bool any = false;
  const auto gather = [&](const SparseCounts& from) {
    from.for_each(base, base + faces_.pieces(), [&](std::size_t i, std::uint32_t count) {
      points[plan.bin_of_piece[i - base]] += static_cast<float>(count);
      seen[i - base] = 1;
      any = true;
    });
  };
  gather(counts);
  if (more != nullptr) {
    gather(*more);
  }
  if (!any) {
    return share;  // slopes: as in most buildings
  }
  const PlanGrid& grid = faces_.grid();
  const std::vector<float> density = local_density(points, plan.bin_area, plan.area_table, grid.nx, grid.ny);
  std::vector<double> covered(complex_.faces(), 0.0);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] != 0) {
      const FaceRaster::Piece& piece = faces_.piece(i);
      covered[static_cast<std::size_t>(piece.face)] +=
          piece.area *
          (tolerances_.correct_density ? occupancy_weight(density[plan.bin_of_piece[i]], piece.area) : 1);
    }
  }
  for (std::size_t f = 0; f < share.size(); ++f) {
    const double area = plan.face_area[f];
    share[f] = area > 0 ? static_cast<float>(std::min(1.0, covered[f] / area)) : 0.0F;
  }
  return share;
}

void LevelRasters::weigh_level(const Plan& plan, std::size_t level, const Occupied& occupied,
                               FaceWeights& weights) const {
  const std::size_t base = level * faces_.pieces();
  const auto face_of = [&](std::size_t i) { return static_cast<std::size_t>(faces_.piece(i - base).face); };
  std::vector<std::uint32_t> sloped(complex_.faces(), 0);
  on_.for_each(base, base + faces_.pieces(), [&](std::size_t i, std::uint32_t count) {
    weights.level_points[complex_.level_face(face_of(i), level)] += count;
  });
  sloped_.for_each(base, base + faces_.pieces(),
                   [&](std::size_t i, std::uint32_t count) { sloped[face_of(i)] += count; });
  const std::vector<float> omega = covered_share(plan, base, on_, &sloped_);
  std::copy(omega.begin(), omega.end(),
            weights.level_omega.begin() + static_cast<std::ptrdiff_t>(complex_.level_face(0, level)));
  const std::vector<double> p_floor =
      floor_probability(complex_, weights, level, sides_of_faces(level, occupied));
  for (std::size_t f = 0; f < complex_.faces(); ++f) {
    const std::size_t i = complex_.level_face(f, level);
    const double flat = weights.level_points[i];
    // A sloped surface counts as the underside of a roof.
    const double floor = flat > 0 ? p_floor[f] * flat / (flat + sloped[f]) : 0;
    weights.level_floor[i] = static_cast<float>(omega[f] * floor);
    weights.level_ceiling[i] = static_cast<float>(omega[f] * (1 - floor));
  }
}

void LevelRasters::weigh_slopes(const Plan& plan, std::size_t layer, FaceWeights& weights) const {
  const std::vector<float> share = covered_share(plan, layer * faces_.pieces(), slope_, nullptr);
  std::copy(share.begin(), share.end(),
            weights.cell_slope.begin() + static_cast<std::ptrdiff_t>(complex_.cell(0, layer)));
}

void LevelRasters::weigh(FaceWeights& weights) const {
  const std::size_t faces = complex_.faces() * complex_.levels.size();
  weights.level_omega.assign(faces, 0);
  weights.level_floor.assign(faces, 0);
  weights.level_ceiling.assign(faces, 0);
  weights.level_points.assign(faces, 0);
  weights.cell_slope.assign(complex_.cells(), 0);
  const Plan plan = measure_plan();
  const Occupied occupied = occupied_bins(plan);
  tbb::parallel_for(std::size_t{0}, complex_.levels.size(), [&](std::size_t level) {
    weigh_level(plan, level, occupied, weights);
    if (level < complex_.layers()) {
      weigh_slopes(plan, level, weights);
    }
  });
}

}  // namespace roomcut::weigh_faces

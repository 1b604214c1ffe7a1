// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/level_rasters.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "stages/weigh_faces/components.h"

namespace roomcut {

LevelRasters::LevelRasters(const CellComplex& complex, const Tolerances& tolerances)
    : complex_(complex),
      tolerances_(tolerances),
      faces_(complex, tolerances.bin, tolerances.core_margin),
      on_(complex.levels.size() * faces_.pieces()),
      sloped_(complex.levels.size() * faces_.pieces()),
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

std::vector<std::vector<std::uint8_t>> LevelRasters::occupied_bins() const {
  std::vector<std::vector<std::uint8_t>> occupied(complex_.levels.size());
  tbb::parallel_for(std::size_t{0}, occupied.size(), [&](std::size_t level) {
    occupied[level].assign(faces_.grid().size(), 0);
    for (std::size_t bin = 0; bin < faces_.grid().size(); ++bin) {
      for (std::size_t i = faces_.first(bin); i < faces_.first(bin + 1) && occupied[level][bin] == 0; ++i) {
        occupied[level][bin] = on_.at(level * faces_.pieces() + i) > 0 ? 1 : 0;
      }
    }
  });
  return occupied;
}

void LevelRasters::add_gap(std::size_t level, std::size_t bin,
                           const std::vector<std::vector<std::uint8_t>>& occupied, Sides& sides) const {
  constexpr double kTall = 1.0;   // [m] room for a person to stoop: a room, not a plenum
  constexpr double kShort = 0.7;  // [m] at most a thick slab
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
  const auto closed = [](double gap) { return gap < kShort || gap == kNothing; };
  sides.open_over += open(above) && closed(below) ? 1 : 0;
  sides.open_under += open(below) && closed(above) ? 1 : 0;
}

std::vector<double> LevelRasters::floor_probability(
    std::size_t level, const std::vector<std::vector<std::uint8_t>>& occupied) const {
  const PlanGrid& grid = faces_.grid();
  const Components components = find_components(occupied[level], grid.nx, grid.ny);
  std::vector<Sides> of_component(static_cast<std::size_t>(components.count));
  std::vector<Sides> of_face(complex_.faces());
  for (std::size_t bin = 0; bin < grid.size(); ++bin) {
    // Points beside a component's rim (a wall's foot) count too: its bins are grown by one.
    const std::int32_t c = components.grown[bin];
    if (c < 0) {
      continue;
    }
    Sides here;
    here.over = over_.at(level * grid.size() + bin) > 0 ? 1 : 0;
    here.under = under_.at(level * grid.size() + bin) > 0 ? 1 : 0;
    if (occupied[level][bin] != 0) {
      add_gap(level, bin, occupied, here);
    }
    const auto add = [&here](Sides& sum) {
      sum.over += here.over;
      sum.under += here.under;
      sum.open_over += here.open_over;
      sum.open_under += here.open_under;
    };
    add(of_component[static_cast<std::size_t>(c)]);
    for (std::size_t i = faces_.first(bin); i < faces_.first(bin + 1); ++i) {
      add(of_face[static_cast<std::size_t>(faces_.piece(i).face)]);
    }
  }
  constexpr double kPrior = 10;  // bins that the component's evidence is worth in a face of its own opinion
  std::vector<double> probability(faces_.pieces(), 0.5);
  for (std::size_t bin = 0; bin < grid.size(); ++bin) {
    const std::int32_t c = components.grown[bin];
    if (c < 0) {
      continue;
    }
    const Sides& whole = of_component[static_cast<std::size_t>(c)];
    const double prior = (whole.over - whole.under) / (whole.over + whole.under + 2);
    for (std::size_t i = faces_.first(bin); i < faces_.first(bin + 1); ++i) {
      const Sides& own = of_face[static_cast<std::size_t>(faces_.piece(i).face)];
      const double beside = (own.over - own.under + kPrior * prior) / (own.over + own.under + kPrior);
      const double gap = (own.open_over - own.open_under) / (own.open_over + own.open_under + 2);
      probability[i] = 1 / (1 + std::exp(-6 * (beside + 0.4 * gap)));
    }
  }
  return probability;
}

void LevelRasters::weigh_level(std::size_t level, const std::vector<std::vector<std::uint8_t>>& occupied,
                               FaceWeights& weights) const {
  const PlanGrid& grid = faces_.grid();
  std::vector<float> points(grid.size(), 0.0F);
  std::vector<float> areas(grid.size(), 0.0F);
  for (std::size_t bin = 0; bin < grid.size(); ++bin) {
    for (std::size_t i = faces_.first(bin); i < faces_.first(bin + 1); ++i) {
      points[bin] +=
          static_cast<float>(on_.at(level * faces_.pieces() + i) + sloped_.at(level * faces_.pieces() + i));
      areas[bin] += faces_.piece(i).area;
    }
  }
  const std::vector<float> density = local_density(points, areas, grid.nx, grid.ny);
  const std::vector<double> p_floor = floor_probability(level, occupied);
  std::vector<double> area(complex_.faces(), 0.0);
  std::vector<double> floor(complex_.faces(), 0.0);
  std::vector<double> ceiling(complex_.faces(), 0.0);
  for (std::size_t bin = 0; bin < grid.size(); ++bin) {
    for (std::size_t i = faces_.first(bin); i < faces_.first(bin + 1); ++i) {
      const FaceRaster::Piece& piece = faces_.piece(i);
      const auto f = static_cast<std::size_t>(piece.face);
      area[f] += piece.area;
      const std::uint32_t flat = on_.at(level * faces_.pieces() + i);
      const std::uint32_t sloped = sloped_.at(level * faces_.pieces() + i);
      if (flat + sloped == 0) {
        continue;
      }
      const double covered = piece.area * occupancy_weight(density[bin], piece.area);
      const double floor_share = p_floor[i] * flat / (flat + sloped);
      floor[f] += covered * floor_share;
      ceiling[f] += covered * (1 - floor_share);
      weights.level_points[complex_.level_face(f, level)] += flat;
    }
  }
  for (std::size_t f = 0; f < complex_.faces(); ++f) {
    const double covered = floor[f] + ceiling[f];
    if (area[f] > 0 && covered > 0) {
      const double omega = std::min(1.0, covered / area[f]);
      const std::size_t i = complex_.level_face(f, level);
      weights.level_omega[i] = static_cast<float>(omega);
      weights.level_floor[i] = static_cast<float>(omega * floor[f] / covered);
      weights.level_ceiling[i] = static_cast<float>(omega * ceiling[f] / covered);
    }
  }
}

void LevelRasters::weigh(FaceWeights& weights) const {
  const std::size_t faces = complex_.faces() * complex_.levels.size();
  weights.level_omega.assign(faces, 0);
  weights.level_floor.assign(faces, 0);
  weights.level_ceiling.assign(faces, 0);
  weights.level_points.assign(faces, 0);
  const std::vector<std::vector<std::uint8_t>> occupied = occupied_bins();
  tbb::parallel_for(std::size_t{0}, complex_.levels.size(),
                    [&](std::size_t level) { weigh_level(level, occupied, weights); });
}

}  // namespace roomcut

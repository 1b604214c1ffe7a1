// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/storeys.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace roomcut::extract {

std::int16_t storey_of_run(const std::vector<double>& floor_z, double bottom, double top, double gap_m) {
  for (std::size_t i = floor_z.size(); i-- > 1;) {
    if (floor_z[i] <= bottom + gap_m / 2 && floor_z[i] < top) {
      return static_cast<std::int16_t>(i);
    }
  }
  return 0;
}

namespace {

std::vector<double> floor_area_per_level(const CellComplex& complex, const std::vector<std::uint8_t>& label) {
  std::vector<double> area(complex.levels.size(), 0);
  for_each_run(complex, label,
               [&](std::size_t face, std::size_t first, std::size_t) { area[first] += complex.area(face); });
  return area;
}

std::vector<double> seeds(const std::vector<double>& levels, const std::vector<double>& area, double gap) {
  std::vector<std::size_t> order(levels.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return area[a] > area[b]; });
  std::vector<double> floors;
  for (const std::size_t l : order) {
    const bool apart =
        std::all_of(floors.begin(), floors.end(), [&](double z) { return std::abs(z - levels[l]) >= gap; });
    if (area[l] > 0 && apart) {
      floors.push_back(levels[l]);
    }
  }
  std::sort(floors.begin(), floors.end());
  return floors;
}

// Drops the storey with the least floor when it has too little; returns whether it did.
bool drop_smallest(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                   const StoreyParams& params, std::vector<double>& floor_z) {
  if (floor_z.size() < 2) {
    return false;
  }
  std::vector<double> area(floor_z.size(), 0);
  for_each_run(complex, label, [&](std::size_t face, std::size_t first, std::size_t last) {
    const auto storey =
        storey_of_run(floor_z, complex.levels[first], complex.levels[last], params.least_gap_m);
    area[static_cast<std::size_t>(storey)] += complex.area(face);
  });
  const auto smallest = std::min_element(area.begin(), area.end());
  constexpr double kLeastShare = 0.05;
  if (*smallest >=
      std::max(params.least_floor_m2, kLeastShare * *std::max_element(area.begin(), area.end()))) {
    return false;
  }
  floor_z.erase(floor_z.begin() + (smallest - area.begin()));
  return true;
}

}  // namespace

Storeys find_storeys(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                     const StoreyParams& params) {
  Storeys out;
  out.floor_z = seeds(complex.levels, floor_area_per_level(complex, label), params.least_gap_m);
  while (drop_smallest(complex, label, params, out.floor_z)) {
  }
  out.of_cell.assign(complex.cells(), -1);
  for_each_run(complex, label, [&](std::size_t face, std::size_t first, std::size_t last) {
    const auto storey =
        storey_of_run(out.floor_z, complex.levels[first], complex.levels[last], params.least_gap_m);
    for (std::size_t k = first; k < last; ++k) {
      out.of_cell[complex.cell(face, k)] = storey;
    }
  });
  return out;
}

}  // namespace roomcut::extract

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/energy.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/cells/interfaces.h"

namespace roomcut::graphcut {

double quantised(double value_m3) {
  return std::nearbyint(value_m3 / EnergyTerms::kQuantum_m3) * EnergyTerms::kQuantum_m3;
}

namespace {

/// What is charged of a face of which `omega` was seen.
double unseen(double omega, double free_from) {
  return std::max(0.0, 1 - omega / free_from);
}

}  // namespace

EnergyTerms energy_terms(const CellComplex& complex, const FaceWeights& weights, const DataTerms& terms,
                         const GraphcutParams& params) {
  if (terms.d_empty.size() != complex.cells() || terms.d_solid.size() != complex.cells() ||
      weights.wall_omega.size() != complex.edges.size() * complex.layers() ||
      weights.level_omega.size() != complex.faces() * complex.levels.size() ||
      terms.wall_implied.size() != weights.wall_omega.size() ||
      terms.level_implied.size() != weights.level_omega.size()) {
    throw std::logic_error("weights or data terms do not fit the complex");
  }
  EnergyTerms energy;
  energy.d_empty.resize(complex.cells());
  energy.d_solid.resize(complex.cells());
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    energy.d_empty[c] = quantised(terms.d_empty[c]);
    energy.d_solid[c] = quantised(terms.d_solid[c]);
  }
  energy.wall.resize(weights.wall_omega.size());
  energy.level.resize(weights.level_omega.size());
  for_each_interface(complex, [&](const Interface& face) {
    const double omega = face.wall ? weights.wall_omega[face.index] : weights.level_omega[face.index];
    const double implied = face.wall ? terms.wall_implied[face.index] : terms.level_implied[face.index];
    (face.wall ? energy.wall : energy.level)[face.index] =
        quantised(params.mu_m * unseen(omega, params.free_from) * (1.0 - implied) * face.area);
  });
  return energy;
}

Energy energy_of(const CellComplex& complex, const EnergyTerms& terms,
                 const std::vector<std::uint8_t>& label) {
  Energy energy;
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    energy.data_m3 += is_empty(label, c) ? terms.d_empty[c] : terms.d_solid[c];
  }
  for_each_interface(complex, [&](const Interface& face) {
    if (is_surface(face, label)) {
      energy.boundary_m3 += (face.wall ? terms.wall : terms.level)[face.index];
    }
  });
  return energy;
}

double flip_cost(const CellComplex& complex, const EnergyTerms& terms, const std::vector<std::uint8_t>& label,
                 std::size_t cell) {
  const bool empty = is_empty(label, cell);
  double cost = empty ? terms.d_solid[cell] - terms.d_empty[cell] : terms.d_empty[cell] - terms.d_solid[cell];
  for_each_interface_of(complex, cell, [&](const Interface& face, std::int64_t other) {
    const double term = (face.wall ? terms.wall : terms.level)[face.index];
    cost += is_empty(label, other) == empty ? term : -term;
  });
  return cost;
}

}  // namespace roomcut::graphcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/energy.h"

#include <gtest/gtest.h>

#include "tests/unit/graphcut/random_cells.h"

namespace roomcut::graphcut {
using namespace roomcut::testing;

namespace {

TEST(Energy, OfOneEmptyCubeIsItsDataTermAndItsSurface) {
  const CellComplex complex = grid_complex(3, 3, 3);
  const EnergyTerms terms = energy_terms(
      complex, no_weights(complex), terms_of(complex, std::vector<float>(complex.cells(), 0.25F)), {0.5});
  std::vector<std::uint8_t> label(complex.cells(), 0);
  EXPECT_NEAR(energy_of(complex, terms, label).total_m3(), 27 * 0.25, 1e-9);
  label[complex.cell(4, 1)] = 1;
  const Energy energy = energy_of(complex, terms, label);
  EXPECT_NEAR(energy.data_m3, 26 * 0.25 + 0.75, 1e-9);
  EXPECT_NEAR(energy.boundary_m3, 6 * 0.5, 1e-9);
}

TEST(Energy, CoveredFacesAreFreeAndTheBoundingBoxIsSolid) {
  const CellComplex complex = grid_complex(2, 2, 1);
  FaceWeights weights = no_weights(complex);
  const DataTerms terms = terms_of(complex, std::vector<float>(complex.cells(), 0.5F));
  const std::vector<std::uint8_t> all_empty(complex.cells(), 1);
  EXPECT_NEAR(energy_of(complex, energy_terms(complex, weights, terms, {1.0}), all_empty).boundary_m3,
              4 + 4 + 8, 1e-9);
  weights.level_omega.assign(weights.level_omega.size(), 1.0F);
  EXPECT_NEAR(energy_of(complex, energy_terms(complex, weights, terms, {1.0}), all_empty).boundary_m3, 8,
              1e-9);
}

TEST(Energy, FromWhichCoverageOnAFaceIsFreeIsAParameterAndOneIsThePapers) {
  const CellComplex complex = grid_complex(2, 2, 1);
  FaceWeights weights = no_weights(complex);
  const DataTerms terms = terms_of(complex, std::vector<float>(complex.cells(), 0.5F));
  const std::vector<std::uint8_t> all_empty(complex.cells(), 1);
  weights.level_omega.assign(weights.level_omega.size(), 0.25F);
  const auto surface = [&](double free_from) {
    const EnergyTerms energy = energy_terms(complex, weights, terms, {.mu_m = 1, .free_from = free_from});
    return energy_of(complex, energy, all_empty).boundary_m3;
  };
  EXPECT_NEAR(surface(1), 8 + 8 * 0.75, 1e-6);
  EXPECT_NEAR(surface(0.5), 8 + 8 * 0.5, 1e-6);
  EXPECT_NEAR(surface(0.25), 8, 1e-6);
}

TEST(Energy, CostOfAFlipIsTheDifferenceOfBothEnergiesExactly) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CellComplex complex = random_complex(seed, 8, 3);
    const EnergyTerms terms =
        energy_terms(complex, random_weights(complex, seed), random_terms(complex, seed), {0.3});
    std::vector<std::uint8_t> label = random_labels(complex, seed, 0.5);
    const double before = energy_of(complex, terms, label).total_m3();
    for (std::size_t c = 0; c < complex.cells(); c += 7) {
      const double cost = flip_cost(complex, terms, label, c);
      label[c] ^= 1;
      EXPECT_EQ(energy_of(complex, terms, label).total_m3(), before + cost);
      label[c] ^= 1;
    }
  }
}

}  // namespace
}  // namespace roomcut::graphcut

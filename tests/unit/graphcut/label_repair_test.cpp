// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/label_repair.h"

#include <gtest/gtest.h>

#include "stages/graphcut/max_flow.h"
#include "tests/unit/graphcut/manifold_by_mesh.h"
#include "tests/unit/graphcut/random_cells.h"

namespace roomcut::graphcut {
using namespace roomcut::testing;

namespace {

TEST(LabelRepair, MakesAnyLabellingManifold) {
  int repaired = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const CellComplex complex =
        random_complex(seed % 100, 6 + static_cast<int>(seed % 20), 1 + static_cast<int>(seed % 4));
    const ManifoldCheck check(complex);
    const EnergyTerms terms =
        energy_terms(complex, random_weights(complex, seed), random_terms(complex, seed), {0.3});
    const std::vector<std::uint8_t> label =
        random_labels(complex, seed, 0.1 + 0.2 * static_cast<double>(seed % 5));
    const Repair repair = repair_labels(check, terms, label);
    ASSERT_TRUE(check.find_all(repair.label).empty()) << "seed " << seed;
    if (seed % 10 == 0) {
      ASSERT_TRUE(non_manifold_vertices(complex, repair.label).empty()) << "seed " << seed;
    }
    EXPECT_EQ(energy_of(complex, terms, repair.label).total_m3(),
              energy_of(complex, terms, label).total_m3() + repair.added_m3);
    repaired += repair.flips > 0 ? 1 : 0;
  }
  EXPECT_GT(repaired, 700);
}

TEST(LabelRepair, LeavesAManifoldLabellingAlone) {
  const CellComplex complex = grid_complex(5, 5, 3);
  const EnergyTerms terms =
      energy_terms(complex, random_weights(complex, 1), random_terms(complex, 1), {0.3});
  std::vector<std::uint8_t> label(complex.cells(), 0);
  label[complex.cell(12, 1)] = 1;
  const Repair repair = repair_labels(ManifoldCheck(complex), terms, label);
  EXPECT_EQ(repair.flips, 0);
  EXPECT_EQ(repair.label, label);
}

TEST(LabelRepair, TakesTheCheapestWayOutOfADiagonal) {
  // Two rooms that touch at a vertical edge: one of the four cells around it has to change.
  const CellComplex complex = grid_complex(4, 4, 3);
  std::vector<std::size_t> around;
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    if ((complex.centroid(f) - Vec2(2, 2)).cwiseAbs().maxCoeff() < 0.6) {
      around.push_back(complex.cell(f, 1));
    }
  }
  ASSERT_EQ(around.size(), 4U);
  const auto diagonal = [&](std::size_t i) {
    const Vec2 c = complex.centroid(complex.face_of(around[i])) - Vec2(2, 2);
    return c.x() * c.y() > 0;
  };
  std::vector<std::uint8_t> label(complex.cells(), 0);
  for (std::size_t i = 0; i < 4; ++i) {
    label[around[i]] = diagonal(i) ? 1 : 0;
  }
  for (std::size_t cheap = 0; cheap < 4; ++cheap) {
    std::vector<float> beta(complex.cells());
    for (std::size_t c = 0; c < beta.size(); ++c) {
      beta[c] = label[c] != 0 ? 0.9F : 0.1F;
    }
    beta[around[cheap]] = 0.5F;
    const EnergyTerms terms = energy_terms(complex, no_weights(complex), terms_of(complex, beta), {0.001});
    const Repair repair = repair_labels(ManifoldCheck(complex), terms, label);
    EXPECT_EQ(repair.flips, 1);
    EXPECT_NE(repair.label[around[cheap]], label[around[cheap]]);
  }
}

TEST(LabelRepair, OfAnOptimalCutNeverLowersTheEnergy) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const CellComplex complex = random_complex(seed, 12, 3);
    const EnergyTerms terms =
        energy_terms(complex, random_weights(complex, seed), random_terms(complex, seed), {0.1});
    EXPECT_GE(repair_labels(ManifoldCheck(complex), terms, minimum_cut(complex, terms).label).added_m3, 0);
  }
}

}  // namespace
}  // namespace roomcut::graphcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/max_flow.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/graphcut/random_cells.h"

namespace roomcut::graphcut {
using namespace roomcut::testing;

namespace {

struct Best {
  double energy = 1e300;
  std::int64_t fewest_empty = 0;
};

Best by_trying_all(const CellComplex& complex, const EnergyTerms& terms) {
  Best best;
  std::vector<std::uint8_t> label(complex.cells());
  for (std::uint32_t code = 0; code < (1U << complex.cells()); ++code) {
    for (std::size_t c = 0; c < complex.cells(); ++c) {
      label[c] = (code >> c) & 1U;
    }
    const double energy = energy_of(complex, terms, label).total_m3();
    const std::int64_t empty = std::count(label.begin(), label.end(), 1);
    if (energy < best.energy || (energy == best.energy && empty < best.fewest_empty)) {
      best = {energy, empty};
    }
  }
  return best;
}

TEST(MaxFlow, FindsTheLeastEnergyOfAllLabellings) {
  int with_both_labels = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const CellComplex complex = seed % 3 == 0 ? grid_complex(2, 2, 3) : random_complex(seed, 2, 3);
    if (complex.cells() > 12) {
      continue;
    }
    const double mu = 0.02 * static_cast<double>(1 + seed % 7);
    const EnergyTerms terms =
        energy_terms(complex, random_weights(complex, seed), random_terms(complex, seed), {mu});
    const Cut cut = minimum_cut(complex, terms);
    const Best best = by_trying_all(complex, terms);
    EXPECT_EQ(cut.flow_m3, best.energy);
    EXPECT_EQ(energy_of(complex, terms, cut.label).total_m3(), best.energy);
    const std::int64_t empty = std::count(cut.label.begin(), cut.label.end(), 1);
    EXPECT_EQ(empty, best.fewest_empty);
    with_both_labels += empty > 0 && empty < static_cast<std::int64_t>(complex.cells()) ? 1 : 0;
  }
  EXPECT_GT(with_both_labels, 20);
}

TEST(MaxFlow, RepeatedCutsLabelAsIfEachWereTheFirst) {
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const CellComplex complex = random_complex(seed, 5, 3);
    EnergyTerms terms =
        energy_terms(complex, random_weights(complex, seed), random_terms(complex, seed), {0.1});
    RepeatedCut repeated(complex, terms);
    std::vector<std::uint8_t> before;
    for (std::uint64_t turn = 0; turn < 6; ++turn) {
      const EnergyTerms other = energy_terms(complex, random_weights(complex, seed),
                                             random_terms(complex, 100 * turn + seed), {0.1});
      std::vector<double> gain(complex.cells());
      for (std::size_t c = 0; c < gain.size(); ++c) {
        terms.d_empty[c] = other.d_empty[c];
        terms.d_solid[c] = other.d_solid[c];
        gain[c] = terms.d_solid[c] - terms.d_empty[c];
      }
      const std::vector<std::uint8_t> label = repeated.label(gain);
      ASSERT_EQ(label, minimum_cut(complex, terms).label);
      changed += label != before ? 1 : 0;
      before = label;
    }
  }
  EXPECT_GT(changed, 40);
}

TEST(MaxFlow, OfEqualLabellingsTakesTheOneWithFewestEmptyCells) {
  const CellComplex complex = grid_complex(3, 3, 3);
  DataTerms undecided = terms_of(complex, std::vector<float>(complex.cells(), 0.5F));
  FaceWeights covered = no_weights(complex);
  covered.wall_omega.assign(covered.wall_omega.size(), 1.0F);
  covered.level_omega.assign(covered.level_omega.size(), 1.0F);
  const Cut cut = minimum_cut(complex, energy_terms(complex, covered, undecided, {0.3}));
  EXPECT_EQ(std::count(cut.label.begin(), cut.label.end(), 1), 0);
}

TEST(MaxFlow, FlowIsTheEnergyOnLargerComplexesToo) {
  const CellComplex complex = random_complex(3, 60, 6);
  const EnergyTerms terms =
      energy_terms(complex, random_weights(complex, 3), random_terms(complex, 3), {0.1});
  const Cut cut = minimum_cut(complex, terms);
  EXPECT_EQ(cut.flow_m3, energy_of(complex, terms, cut.label).total_m3());
}

}  // namespace
}  // namespace roomcut::graphcut

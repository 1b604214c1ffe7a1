// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/doubt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/cells/interfaces.h"
#include "common/cells/manifold_check.h"
#include "common/errors/error.h"
#include "common/random/counter_random.h"
#include "stages/graphcut/graphcut.h"
#include "stages/graphcut/max_flow.h"
#include "tests/unit/graphcut/random_cells.h"

namespace roomcut::graphcut {
using namespace roomcut::testing;

namespace {

/// How a space was seen: probability of being empty, share seen from inside, share closed all around.
struct Look {
  float beta, seen, closed;
};

void look(DataTerms& terms, const CellComplex& complex, std::size_t cell, const Look& look) {
  const double volume = complex.volume(cell);
  terms.beta[cell] = look.beta;
  terms.around[cell] = 2 * look.seen - terms.observed[cell];
  terms.closed[cell] = look.closed;
  terms.d_empty[cell] = volume * (1 - static_cast<double>(look.beta));
  terms.d_solid[cell] = volume * static_cast<double>(look.beta);
}

/// A seen room of 2 x 2 x 2 m and beside it, behind walls without thickness, a space of the same size.
struct TwoSpaces {
  CellComplex complex = grid_complex(6, 4, 4);
  FaceWeights weights = no_weights(complex);
  std::vector<std::size_t> room, space;
  DataTerms terms = terms_of(complex, std::vector<float>(complex.cells(), 0.02F));

  explicit TwoSpaces(const Look& of_space) {
    std::vector<int> part(complex.cells(), 0);
    for (std::size_t c = 0; c < complex.cells(); ++c) {
      const Vec3 at = complex.centre(c);
      look(terms, complex, c, {0.02F, 1, 1});
      if (at.y() > 1 && at.y() < 3 && at.z() > 1 && at.z() < 3 && at.x() > 1 && at.x() < 5) {
        part[c] = at.x() < 3 ? 1 : 2;
        (part[c] == 1 ? room : space).push_back(c);
        look(terms, complex, c, part[c] == 1 ? Look{0.98F, 1, 1} : of_space);
      }
    }
    for_each_interface(complex, [&](const Interface& face) {
      const auto of = [&](std::int64_t cell) { return cell < 0 ? 0 : part[static_cast<std::size_t>(cell)]; };
      if (of(face.a) != of(face.b)) {
        (face.wall ? weights.wall_omega : weights.level_omega)[face.index] = 1;
      }
    });
  }

  std::uint8_t label_of_space(const std::string& unknown = "apart") const {
    GraphcutParams params;
    params.unknown = unknown;
    const Graphcut result = graphcut(complex, weights, terms, params);
    for (const std::size_t cell : room) {
      EXPECT_EQ(result.labels.label[cell], Label::kEmpty);
    }
    for (const std::size_t cell : space) {
      EXPECT_EQ(result.labels.label[cell], result.labels.label[space.front()]);
    }
    return result.labels.label[space.front()];
  }
};

TEST(Doubt, WhatWasSeenFromInsideIsInNoDoubt) {
  for (const double closed : {0.0, 0.5, 1.0}) {
    EXPECT_EQ(doubt_of(0.75, closed, 2).invented, 0);
    EXPECT_EQ(doubt_of(0.75, closed, 2).denied, 0);
  }
}

TEST(Doubt, WhatIsClosedMayBeARoomWhatIsOpenMayBeOutdoors) {
  EXPECT_EQ(doubt_of(0, 1, 2).denied, 2);
  EXPECT_EQ(doubt_of(0, 1, 2).invented, 0);
  EXPECT_EQ(doubt_of(0, 0.2, 2).denied, 0);
  EXPECT_EQ(doubt_of(0, 0.2, 2).invented, 1);
  EXPECT_LT(doubt_of(0.3, 1, 2).denied, doubt_of(0.1, 1, 2).denied);
}

TEST(Doubt, AClosedSpaceThatNobodySawIsNotDenied) {
  EXPECT_EQ(TwoSpaces({0.4F, 0.1F, 1}).label_of_space(), Label::kUnknown);
  EXPECT_EQ(TwoSpaces({0.4F, 0.1F, 1}).label_of_space("decided"), Label::kSolid);
  EXPECT_EQ(TwoSpaces({0.4F, 0.1F, 1}).label_of_space("rooms"), Label::kEmpty);
}

TEST(Doubt, AnOpenSpaceThatNobodySawIsNotInvented) {
  EXPECT_EQ(TwoSpaces({0.6F, 0.1F, 0.4F}).label_of_space(), Label::kUnknown);
  EXPECT_EQ(TwoSpaces({0.6F, 0.1F, 0.4F}).label_of_space("decided"), Label::kEmpty);
}

TEST(Doubt, ASpaceOfWhichTheEvidenceIsSureKeepsItsLabel) {
  EXPECT_EQ(TwoSpaces({0.03F, 0.1F, 1}).label_of_space(), Label::kSolid);
  EXPECT_EQ(TwoSpaces({0.9F, 0.1F, 0.4F}).label_of_space(), Label::kEmpty);
  EXPECT_EQ(TwoSpaces({0.7F, 0.1F, 1}).label_of_space(), Label::kEmpty);  // closed, and rather a room
}

TEST(Doubt, ASpaceThatWasSeenKeepsItsLabelHoweverLittleDecidesIt) {
  EXPECT_EQ(TwoSpaces({0.48F, 0.8F, 1}).label_of_space(), Label::kSolid);
  EXPECT_EQ(TwoSpaces({0.52F, 0.8F, 0.4F}).label_of_space(), Label::kEmpty);
}

TEST(Doubt, ASpaceNoWiderThanAWallIsDecided) {
  TwoSpaces scene({0.4F, 0.1F, 1});
  for (CellComplex* complex : {&scene.complex}) {
    for (Vec2& place : complex->vertices) {
      place.x() *= 0.15;  // the space is 0.3 m wide now
    }
  }
  for (std::size_t c = 0; c < scene.complex.cells(); ++c) {
    look(scene.terms, scene.complex, c, {scene.terms.beta[c], 0.1F, 1});
  }
  for (const std::size_t cell : scene.room) {
    look(scene.terms, scene.complex, cell, {0.98F, 1, 1});
  }
  EXPECT_EQ(scene.label_of_space(), Label::kSolid);
}

TEST(Doubt, ASliverOfARoomBetweenUnknownCellsGoesWithThem) {
  TwoSpaces scene({0.4F, 0.1F, 1});
  const std::size_t sliver = scene.space.front();  // surely empty, but 1 m wide: 2 V / A = 0.33 m
  look(scene.terms, scene.complex, sliver, {0.98F, 1, 1});
  for_each_interface_of(scene.complex, sliver, [&](const Interface& face, std::int64_t) {
    (face.wall ? scene.weights.wall_omega : scene.weights.level_omega)[face.index] = 1;
  });
  for (const std::size_t cell : scene.room) {  // a wall of a metre between the two
    if (scene.complex.centre(cell).x() > 2) {
      look(scene.terms, scene.complex, cell, {0.02F, 1, 1});
    }
  }
  GraphcutParams params;
  const Graphcut result = graphcut(scene.complex, scene.weights, scene.terms, params);
  for (const std::size_t cell : scene.space) {
    EXPECT_EQ(result.labels.label[cell], Label::kUnknown);
  }
}

TEST(Doubt, OtherCellsKeepTheirLabelsWhateverTheLogOddsWithinTheDoubt) {
  constexpr double kDoubt = 2;
  CellComplex complex = grid_complex(6, 6, 4);  // cells of 2 m: every piece is wider than a wall
  for (Vec2& place : complex.vertices) place *= 2;
  for (double& level : complex.levels) level *= 2;
  std::int64_t unknown = 0, decided = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    DataTerms terms = random_terms(complex, seed);
    const auto random = [&](std::uint64_t stream, std::size_t cell) {
      return random_unit(seed, stream, cell);
    };
    for (std::size_t c = 0; c < complex.cells(); ++c) {
      look(terms, complex, c,
           {terms.beta[c], static_cast<float>(random(1, c)), static_cast<float>(random(2, c))});
    }
    const FaceWeights weights = random_weights(complex, seed);
    const EnergyTerms energy = energy_terms(complex, weights, terms, {});
    const std::vector<std::uint8_t> cut = minimum_cut(complex, energy).label;
    const std::vector<std::uint8_t> label = doubtful_labels(complex, weights, terms, energy, cut, kDoubt);
    DataTerms other = terms;
    for (std::size_t c = 0; c < complex.cells(); ++c) {
      const Doubt doubt = doubt_of(terms.seen_inside(c), terms.closed[c], kDoubt);
      const double shift = -doubt.invented + random(3, c) * (doubt.invented + doubt.denied);
      const double odds = terms.beta[c] / (1 - static_cast<double>(terms.beta[c])) * std::exp(shift);
      look(other, complex, c, {static_cast<float>(odds / (1 + odds)), 1, 1});
    }
    const std::vector<std::uint8_t> moved =
        minimum_cut(complex, energy_terms(complex, weights, other, {})).label;
    for (std::size_t c = 0; c < complex.cells(); ++c) {
      if (label[c] == Label::kUnknown) {
        ++unknown;
      } else {
        ++decided;
        EXPECT_EQ(moved[c], cut[c]) << "seed " << seed << ", cell " << c;
        EXPECT_EQ(label[c], cut[c]);
      }
    }
  }
  EXPECT_GT(unknown, 100);
  EXPECT_GT(decided, 100);
}

TEST(Doubt, TheModelBesideUnknownCellsIsManifoldAndItsEnergyAddsUp) {
  std::int64_t unknown = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CellComplex complex = random_complex(seed, 15, 3);
    DataTerms terms = random_terms(complex, seed);
    std::fill(terms.around.begin(), terms.around.end(), -0.8F);
    std::fill(terms.closed.begin(), terms.closed.end(), 0.5F);
    GraphcutParams params;
    params.mu_m = 0.05;
    const Graphcut result = graphcut(complex, random_weights(complex, seed), terms, params);
    unknown += result.unknown_cells;
    EXPECT_TRUE(ManifoldCheck(complex).find_all(labels_of_model(result.labels.label)).empty());
    EXPECT_EQ(result.labels.energy_m3, result.cut_m3 + result.unknown_added_m3 + result.repair_m3);
    EXPECT_EQ(result.unknown_cells,
              std::count(result.labels.label.begin(), result.labels.label.end(), Label::kUnknown));
  }
  EXPECT_GT(unknown, 20);
}

TEST(Doubt, WhereNothingIsSurelyARoomTheCutAloneDecides) {
  TwoSpaces scene({0.4F, 0.1F, 1});
  for (const std::size_t cell : scene.room) {
    look(scene.terms, scene.complex, cell, {0.55F, 0.3F, 0.4F});
  }
  EXPECT_EQ(scene.label_of_space(), Label::kSolid);  // which also asks that the room be empty
  EXPECT_TRUE(graphcut(scene.complex, scene.weights, scene.terms, {}).cut_alone);
}

TEST(Doubt, ABuildingOfWhichAllIsUnknownIsAnErrorThatNamesTheSwitch) {
  TwoSpaces scene({0.4F, 0.1F, 1});
  for (const std::size_t cell : scene.room) {
    look(scene.terms, scene.complex, cell, {0.4F, 0.1F, 1});
  }
  try {
    graphcut(scene.complex, scene.weights, scene.terms, {});
    FAIL() << "returned a model without a room";
  } catch (const StageError& error) {
    EXPECT_NE(error.problems()[0].what.find("16 m^3 are unknown"), std::string::npos) << error.what();
    EXPECT_NE(error.problems()[0].hint.find("unknown: rooms"), std::string::npos);
  }
}

}  // namespace
}  // namespace roomcut::graphcut

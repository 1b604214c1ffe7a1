// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/graphcut.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/errors/codes.h"
#include "common/errors/error.h"
#include "stages/graphcut/energy.h"
#include "stages/graphcut/max_flow.h"
#include "tests/unit/graphcut/random_cells.h"

namespace roomcut::graphcut {
using namespace roomcut::testing;

namespace {

std::size_t middle_of(const CellComplex& complex) {
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    if ((complex.centroid(f) - Vec2(1.5, 1.5)).norm() < 0.1) {
      return complex.cell(f, 1);
    }
  }
  return complex.cells();
}

TEST(Graphcut, OneCubeIsEmptyInsideAndSolidOutside) {
  const CellComplex complex = grid_complex(3, 3, 3);
  std::vector<float> beta(complex.cells(), 0.01F);
  beta.at(middle_of(complex)) = 0.99F;
  FaceWeights weights = no_weights(complex);
  weights.wall_omega.assign(weights.wall_omega.size(), 0.285F);
  weights.level_omega.assign(weights.level_omega.size(), 0.285F);
  const Graphcut result = graphcut(complex, weights, terms_of(complex, beta), {});
  EXPECT_EQ(result.empty_cells, 1);
  EXPECT_EQ(result.labels.label[middle_of(complex)], Label::kEmpty);
  EXPECT_NEAR(result.empty_m3, 1.0, 1e-12);
  EXPECT_NEAR(result.labels.data_m3, 27 * 0.01, 1e-6);
  EXPECT_NEAR(result.labels.boundary_m3, 6 * 0.3 * 0.05, 1e-6);
}

TEST(Graphcut, AFaceOfWhichThreeTenthsWereSeenCostsNothing) {
  const CellComplex complex = grid_complex(3, 3, 3);
  std::vector<float> beta(complex.cells(), 0.01F);
  beta.at(middle_of(complex)) = 0.99F;
  FaceWeights weights = no_weights(complex);
  for (const float omega : {0.3F, 0.7F, 1.0F}) {
    weights.wall_omega.assign(weights.wall_omega.size(), omega);
    weights.level_omega.assign(weights.level_omega.size(), omega);
    EXPECT_EQ(graphcut(complex, weights, terms_of(complex, beta), {}).labels.boundary_m3, 0) << omega;
  }
}

TEST(Graphcut, EnergyAddsUpAndTheMarginIsWhatAFlipCosts) {
  const CellComplex complex = random_complex(4, 15, 3);
  GraphcutParams params;
  params.mu_m = 0.05;
  const Graphcut result = graphcut(complex, random_weights(complex, 4), random_terms(complex, 4), params);
  const Labels& labels = result.labels;
  EXPECT_EQ(labels.energy_m3, labels.data_m3 + labels.boundary_m3);
  EXPECT_EQ(labels.energy_m3, result.cut_m3 + result.repair_m3);
  if (labels.repair_flips == 0) {
    EXPECT_GE(*std::min_element(labels.margin_m3.begin(), labels.margin_m3.end()), 0.0F);
  }
  EXPECT_GT(result.empty_cells, 0);
  EXPECT_LT(result.empty_cells, static_cast<std::int64_t>(complex.cells()));
}

TEST(Graphcut, LabelsDoNotChangeWhenThePlanIsTurnedOrMoved) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const CellComplex complex = random_complex(seed, 15, 3);
    CellComplex turned = complex;
    for (Vec2& p : turned.vertices) {
      p = Vec2(0.8 * p.x() - 0.6 * p.y() + 31, 0.6 * p.x() + 0.8 * p.y() - 7);
    }
    GraphcutParams params;
    params.mu_m = 0.05;
    const FaceWeights weights = random_weights(complex, seed);
    const DataTerms terms = random_terms(complex, seed);
    const Graphcut a = graphcut(complex, weights, terms, params);
    const Graphcut b = graphcut(turned, weights, terms, params);
    EXPECT_EQ(a.labels.label, b.labels.label);
    EXPECT_NEAR(a.labels.energy_m3, b.labels.energy_m3, 1e-6);
  }
}

TEST(Graphcut, MoreWeightOnTheSurfaceNeverMakesItLarger) {
  const CellComplex complex = random_complex(8, 20, 3);
  double last = 1e300;
  for (const double mu : {0.01, 0.03, 0.1, 0.2}) {
    const EnergyTerms unit =
        energy_terms(complex, random_weights(complex, 8), random_terms(complex, 8), {1.0});
    const Cut cut = minimum_cut(
        complex, energy_terms(complex, random_weights(complex, 8), random_terms(complex, 8), {mu}));
    const double surface = energy_of(complex, unit, cut.label).boundary_m3;
    EXPECT_LE(surface, last + 1e-6);
    last = surface;
  }
}

TEST(Graphcut, CellsWithoutEvidenceAreReportedAsUnobserved) {
  const CellComplex complex = grid_complex(3, 3, 3);
  std::vector<float> beta(complex.cells(), 0.0F);
  beta.at(middle_of(complex)) = 1.0F;
  DataTerms terms = terms_of(complex, beta);
  terms.observed[middle_of(complex)] = 0.05F;
  FaceWeights weights = no_weights(complex);
  GraphcutParams params;
  params.mu_m = 0.1;
  const Graphcut result = graphcut(complex, weights, terms, params);
  EXPECT_EQ(result.labels.unobserved[middle_of(complex)], 1);
  EXPECT_EQ(std::count(result.labels.unobserved.begin(), result.labels.unobserved.end(), 1), 1);
  EXPECT_NEAR(result.unobserved_empty_m3, 1.0, 1e-12);
}

TEST(Graphcut, AnEmptyModelIsAnErrorThatNamesTheEvidence) {
  const CellComplex complex = grid_complex(3, 3, 3);
  std::vector<float> beta(complex.cells(), 0.0F);
  beta.at(middle_of(complex)) = 0.9F;
  try {
    graphcut(complex, no_weights(complex), terms_of(complex, beta), {});
    FAIL() << "returned a model without a room";
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems()[0].code.id, errors::kEmptyModel.id);
    EXPECT_EQ(error.exit_code(), ExitCode::kNoResult);
    EXPECT_NE(error.problems()[0].what.find("1 m^3 lean towards empty"), std::string::npos) << error.what();
    EXPECT_NE(error.problems()[0].hint.find("mu_m"), std::string::npos);
  }
}

}  // namespace
}  // namespace roomcut::graphcut

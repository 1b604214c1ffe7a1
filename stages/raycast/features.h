// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include "stages/raycast/cell_evidence.h"

namespace roomcut::raycast {

inline constexpr std::size_t kFeatures = 25;
using FeatureValues = std::array<double, kFeatures>;

/// One line of weights.table.
struct FeatureWeight {
  std::string name;
  double weight;        ///< log-odds of empty per unit of the feature
  std::string meaning;  ///< one sentence
};

/// The model of the data term: log-odds of empty = constant + sum of weight * feature.
struct FeatureWeights {
  double constant = 0;
  std::array<FeatureWeight, kFeatures> features;  ///< in the order of features_of()
  std::string source;                             ///< where the figures come from

  double log_odds(const FeatureValues& values) const;
};

/// Reads the text of a weights.table: one line per feature, in any order. Throws std::invalid_argument for a
/// line that is none, an unknown feature, one given twice, or one that is missing.
FeatureWeights parse_weights(const std::string& text);

/// weights.table, as this program was built with it.
const FeatureWeights& shipped_weights();

/// The features of a cell, each a pure function of its evidence (README.md, Weights).
FeatureValues features_of(const CellEvidence& evidence);

}  // namespace roomcut::raycast

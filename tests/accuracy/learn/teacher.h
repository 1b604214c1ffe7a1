// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "stages/raycast/features.h"
#include "tests/accuracy/learn/evolution.h"
#include "tests/accuracy/learn/lesson.h"

namespace roomcut::learn {

/// The table's weights in the order of `names` (of a lesson). Throws std::invalid_argument when one is
/// missing.
Eigen::VectorXd in_order(const raycast::FeatureWeights& table, const std::vector<std::string>& names);

struct School {
  std::vector<Lesson>& lessons;
  Eigen::VectorXd shipped;  ///< what made-up scenes may not become worse than
  Eigen::VectorXd prior;    ///< where the search starts and is drawn to
};

/// The weights of least cost on all lessons but those of `left_out` ("" = none): the mean loss of the real
/// buildings, each counting once however many lessons it has, and of made-up scenes above all what becomes
/// worse; a little for the distance from the prior, which a weight keeps whose feature no lesson has. What
/// the prior says speaks for empty never speaks against it, and the other way round. Parallel over the
/// lessons; the same for any number of threads. Throws std::invalid_argument when no lesson is left.
Evolved learned_weights(const School& school, const std::string& left_out, const EvolutionParams& params);

}  // namespace roomcut::learn

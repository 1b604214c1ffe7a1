// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace roomcut::learn {

/// Costs of several candidates at once, so that they may be computed in parallel.
using Costs = std::function<std::vector<double>(const std::vector<Eigen::VectorXd>&)>;

struct EvolutionParams {
  double sigma = 0.3;  ///< first step, in units of `scale`
  int generations = 100;
  int candidates = 12;  ///< per generation
  std::uint64_t seed = 1;
};

struct Evolved {
  Eigen::VectorXd best;
  double cost;
};

/// Minimises a function that has steps and no gradient by CMA-ES (Hansen 2016, The CMA Evolution Strategy: A
/// Tutorial, arXiv:1604.00772, with its default settings). `scale`: how much of each variable is one unit.
/// `best`: the middle of the last generation, where that is as good as the best candidate of all. The same
/// result for the same seed.
Evolved evolve(const Costs& costs, const Eigen::VectorXd& start, const Eigen::VectorXd& scale,
               const EvolutionParams& params);

}  // namespace roomcut::learn

// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/accuracy/learn/evolution.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace roomcut::learn {
namespace {

constexpr double kAsGood = 1.02;  // the luckiest candidate is chance, the middle of the last ones is not

/// Normal numbers that every standard library makes alike (Box and Muller).
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : bits_(seed) {}
  Eigen::VectorXd vector(Eigen::Index size) {
    Eigen::VectorXd v(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      v[i] = std::sqrt(-2 * std::log(uniform())) * std::cos(2 * std::numbers::pi * uniform());
    }
    return v;
  }

 private:
  double uniform() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1.0p-53; }
  std::mt19937_64 bits_;
};

/// What the tutorial's Table 1 gives for a number of variables and of candidates.
struct Rates {
  Rates(double n, int candidates) {
    const int parents = candidates / 2;
    weight.resize(parents);
    for (int i = 0; i < parents; ++i) {
      weight[i] = std::log(parents + 0.5) - std::log(i + 1.0);
    }
    weight /= weight.sum();
    mass = 1 / weight.squaredNorm();
    sigma_path = (mass + 2) / (n + mass + 5);
    damping = 1 + 2 * std::max(0.0, std::sqrt((mass - 1) / (n + 1)) - 1) + sigma_path;
    path = (4 + mass / n) / (n + 4 + 2 * mass / n);
    one = 2 / ((n + 1.3) * (n + 1.3) + mass);
    several = std::min(1 - one, 2 * (mass - 2 + 1 / mass) / ((n + 2) * (n + 2) + mass));
    length = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
  }
  Eigen::VectorXd weight;
  double mass, sigma_path, damping, path, one, several, length;
};

}  // namespace

Evolved evolve(const Costs& costs, const Eigen::VectorXd& start, const Eigen::VectorXd& scale,
               const EvolutionParams& params) {
  const Eigen::Index n = start.size();
  const Rates rates(static_cast<double>(n), params.candidates);
  Normal normal(params.seed);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(n), path = mean, sigma_path = mean;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n);
  double sigma = params.sigma;
  const auto placed = [&](const Eigen::VectorXd& unit) {
    return Eigen::VectorXd(start + unit.cwiseProduct(scale));
  };
  Evolved found{start, costs({start}).front()};
  for (int generation = 0; generation < params.generations; ++generation) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(covariance);
    const Eigen::VectorXd length = axes.eigenvalues().cwiseMax(1e-14).cwiseSqrt();
    const Eigen::MatrixXd& turn = axes.eigenvectors();
    std::vector<Eigen::VectorXd> step, candidate;
    for (int i = 0; i < params.candidates; ++i) {
      step.emplace_back(turn * length.cwiseProduct(normal.vector(n)));
      candidate.push_back(placed(mean + sigma * step.back()));
    }
    const std::vector<double> cost = costs(candidate);
    std::vector<std::size_t> order(cost.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return cost[a] < cost[b]; });
    if (cost[order[0]] < found.cost) {
      found = {candidate[order[0]], cost[order[0]]};
    }
    Eigen::VectorXd mean_step = Eigen::VectorXd::Zero(n);
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < rates.weight.size(); ++i) {
      const Eigen::VectorXd& s = step[order[static_cast<std::size_t>(i)]];
      mean_step += rates.weight[i] * s;
      spread += rates.weight[i] * s * s.transpose();
    }
    mean += sigma * mean_step;
    const Eigen::VectorXd round = turn * (turn.transpose() * mean_step).cwiseQuotient(length);
    sigma_path = (1 - rates.sigma_path) * sigma_path +
                 std::sqrt(rates.sigma_path * (2 - rates.sigma_path) * rates.mass) * round;
    path = (1 - rates.path) * path + std::sqrt(rates.path * (2 - rates.path) * rates.mass) * mean_step;
    covariance = (1 - rates.one - rates.several) * covariance + rates.one * path * path.transpose() +
                 rates.several * spread;
    sigma *= std::exp(rates.sigma_path / rates.damping * (sigma_path.norm() / rates.length - 1));
  }
  const Eigen::VectorXd middle = placed(mean);
  if (const double cost = costs({middle}).front(); cost <= kAsGood * found.cost) {
    return {middle, cost};
  }
  return found;
}

}  // namespace roomcut::learn

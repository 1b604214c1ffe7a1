// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/line_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace roomcut {

namespace {

constexpr int kIterations = 50;
constexpr double kMadToSigma = 1.4826;
/// Huber's scale of a Cauchy fit on normal noise: what the measured one is drawn towards.
constexpr double kExpectedScale = 1.053;
/// Weight of that expectation, in observations.
constexpr double kExpectedWeight = 20;
constexpr double kParameters = 2;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// One Gauss-Newton step; returns its size relative to the prior.
double step(const LineProblem& problem, Pose& pose) {
  const Pose home = unmoved(problem);
  const LinePrior& prior = problem.prior;
  Eigen::Matrix2d normal =
      Eigen::Vector2d(1 / (prior.turn_rad * prior.turn_rad), 1 / (prior.shift_m * prior.shift_m))
          .asDiagonal();
  Eigen::Vector2d right(-(pose.turn - home.turn) * normal(0, 0), -(pose.shift - home.shift) * normal(1, 1));
  for (const LineResidual& residual : problem.residuals) {
    const double r = residual.value(pose);
    const double weight = 1 / (1 + r * r / (kCauchy * kCauchy));
    const Eigen::Vector2d j(residual.by_turn(pose), residual.by_shift());
    normal += weight * j * j.transpose();
    right -= weight * r * j;
  }
  const Eigen::Vector2d change = normal.ldlt().solve(right);
  pose.turn += change(0);
  pose.shift += change(1);
  return std::abs(change(0)) / prior.turn_rad + std::abs(change(1)) / prior.shift_m;
}

Pose solve(const LineProblem& problem, Pose pose) {
  for (int i = 0; i < kIterations && step(problem, pose) > 1e-9; ++i) {
  }
  return pose;
}

/// What the observations scatter beyond their sigma [m].
double unevenness(const LineProblem& problem, const Pose& pose) {
  std::vector<double> deviations;
  std::vector<double> variances;
  for (const LineResidual& residual : problem.residuals) {
    deviations.push_back(std::abs(residual.value(pose)) * residual.sigma);
    variances.push_back(residual.sigma * residual.sigma);
  }
  const double spread = kMadToSigma * median(deviations);
  return std::sqrt(std::max(0.0, spread * spread - median(variances)));
}

/// How much larger the variance of a mean is because neighbouring residuals resemble each other: (1 + rho) /
/// (1 - rho), with rho less its own standard error, so that independent residuals give nearly 1.
double correlation_factor(const LineProblem& problem, const Pose& pose) {
  double products = 0;
  double squares = 0;
  double pairs = 0;
  double previous = 0;
  const auto bounded = [&](const LineResidual& r) { return std::clamp(r.value(pose), -kCauchy, kCauchy); };
  for (std::size_t i = 0; i < problem.residuals.size(); ++i) {
    const double r = bounded(problem.residuals[i]);
    squares += r * r;
    if (i > 0) {
      products += r * previous;
      pairs += 1;
    }
    previous = r;
  }
  if (pairs < 3 || squares <= 0) {
    return 1;
  }
  const double n = static_cast<double>(problem.residuals.size());
  const double rho = std::clamp(products / squares * n / pairs - 1 / std::sqrt(n), 0.0, 0.9);
  return (1 + rho) / (1 - rho);
}

/// Huber's scale: mean psi^2 / (mean psi')^2.
double scale(const LineProblem& problem, const Pose& pose) {
  double squares = 0;
  double slopes = 0;
  for (const LineResidual& residual : problem.residuals) {
    const double r = residual.value(pose);
    const double q = r * r / (kCauchy * kCauchy);
    squares += r * r / ((1 + q) * (1 + q));
    slopes += (1 - q) / ((1 + q) * (1 + q));
  }
  const double n = static_cast<double>(problem.residuals.size());
  const double slope = std::max(0.3, slopes / n);
  const double measured = squares / std::max(1.0, n - kParameters) / (slope * slope);
  const double own = std::max(0.0, n - kParameters);
  return (kExpectedWeight * kExpectedScale + own * measured) / (kExpectedWeight + own);
}

}  // namespace

LineProblem make_problem(const Line2& line, const Vec2& centre_without,
                         const std::vector<Observation>& observations, const LinePrior& prior) {
  LineProblem problem{line, centre_without, prior, {}, {}};
  double weights = 0;
  Vec2 sum(0, 0);
  for (const Observation& o : observations) {
    weights += 1 / o.variance_m2;
    sum += o.point / o.variance_m2;
  }
  if (weights > 0) {
    problem.centre = sum / weights;
  }
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Vec2 p = observations[i].point - problem.centre;
    problem.residuals.push_back(
        {line.normal().dot(p), line.direction().dot(p), std::sqrt(observations[i].variance_m2)});
    if (i > 0) {
      problem.spacing.push_back(problem.residuals[i].t - problem.residuals[i - 1].t);
    }
  }
  return problem;
}

Pose unmoved(const LineProblem& problem) {
  return {0, -problem.line.distance(problem.centre)};
}

LineFit fit_line(LineProblem& problem) {
  LineFit fit;
  fit.pose = unmoved(problem);
  if (problem.residuals.empty()) {
    fit.covariance = pose_covariance(problem, fit.pose);
    return fit;
  }
  fit.pose = solve(problem, fit.pose);
  fit.unevenness_m = unevenness(problem, fit.pose);
  for (LineResidual& residual : problem.residuals) {
    residual.sigma = std::hypot(residual.sigma, fit.unevenness_m);
  }
  fit.pose = solve(problem, fit.pose);
  fit.covariance = pose_covariance(problem, fit.pose);
  return fit;
}

PoseCovariance pose_covariance(const LineProblem& problem, const Pose& pose, double turn_sigma_rad) {
  const LinePrior& prior = problem.prior;
  Eigen::Matrix2d information =
      Eigen::Vector2d(1 / (prior.turn_rad * prior.turn_rad), 1 / (prior.shift_m * prior.shift_m))
          .asDiagonal();
  if (turn_sigma_rad > 0) {
    information(0, 0) += 1 / (turn_sigma_rad * turn_sigma_rad);
  }
  if (!problem.residuals.empty()) {
    const double factor = scale(problem, pose) * correlation_factor(problem, pose);
    for (const LineResidual& residual : problem.residuals) {
      const Eigen::Vector2d j(residual.by_turn(pose), residual.by_shift());
      information += j * j.transpose() / factor;
    }
  }
  const Eigen::Matrix2d covariance = information.inverse();
  return {covariance(0, 0), covariance(0, 1), covariance(1, 1)};
}

}  // namespace roomcut

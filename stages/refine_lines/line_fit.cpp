// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/line_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace roomcut::refine_lines {

namespace {

constexpr int kIterations = 50;
constexpr double kMadToSigma = 1.4826;
/// Huber's scale of a Tukey fit on normal noise: what the measured one is drawn towards.
constexpr double kExpectedScale = 1.053;
/// Weight of that expectation, in observations.
constexpr double kExpectedWeight = 20;
constexpr double kBound = 2.5;  ///< standard deviations at which a residual is an outlier
constexpr double kParameters = 2;
constexpr double kTypicalUnevenness_m = 0.003;
constexpr double kSurface_m = 0.015;  ///< a wall leans and bends less; what is further off is another surface
constexpr double kNeighbours_m = 0.5;  ///< observations further apart say nothing of correlation

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

enum class Loss { kCauchy, kTukey };
constexpr double kCauchy = 2.385;  ///< wide: finds the way from a bad start

double weight(double r, Loss loss) {
  const double u = r / (loss == Loss::kCauchy ? kCauchy : kTukeyLoss);
  if (loss == Loss::kCauchy) {
    return 1 / (1 + u * u);
  }
  return std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0;
}

/// One Gauss-Newton step; returns its size relative to the prior.
double step(const LineProblem& problem, Loss loss, Pose& pose) {
  const Pose home = unmoved(problem);
  const LinePrior& prior = problem.prior;
  Eigen::Matrix2d normal =
      Eigen::Vector2d(1 / (prior.turn_rad * prior.turn_rad), 1 / (prior.shift_m * prior.shift_m))
          .asDiagonal();
  Eigen::Vector2d right(-(pose.turn - home.turn) * normal(0, 0), -(pose.shift - home.shift) * normal(1, 1));
  const TurnedPose turned(pose);
  for (const LineResidual& residual : problem.residuals) {
    const double r = residual.value(turned);
    const double w = weight(r, loss);
    const Eigen::Vector2d j(residual.by_turn(turned), residual.by_shift());
    normal += w * j * j.transpose();
    right -= w * r * j;
  }
  const Eigen::Vector2d change = normal.ldlt().solve(right);
  pose.turn += change(0);
  pose.shift += change(1);
  return std::abs(change(0)) / prior.turn_rad + std::abs(change(1)) / prior.shift_m;
}

Pose solve(const LineProblem& problem, Pose pose, Loss loss = Loss::kTukey) {
  for (int i = 0; i < kIterations && step(problem, loss, pose) > 1e-9; ++i) {
  }
  return pose;
}

/// Offsets where the line may lie [m]: where it came, the median of the observations, and the two fullest 5
/// mm of them.
std::vector<double> start_offsets(const LineProblem& problem, const Pose& home) {
  constexpr double kBin_m = 0.005;
  std::vector<double> offsets;
  std::map<long, int> bins;
  for (const LineResidual& residual : problem.residuals) {
    offsets.push_back(residual.value(home) * residual.sigma);
    ++bins[std::lround(offsets.back() / kBin_m)];
  }
  std::vector<std::pair<int, long>> fullest;
  fullest.reserve(bins.size());
  for (const auto& [bin, count] : bins) {
    fullest.emplace_back(-count, bin);
  }
  std::sort(fullest.begin(), fullest.end());
  std::vector<double> starts{0, median(offsets)};
  for (std::size_t i = 0; i < std::min<std::size_t>(2, fullest.size()); ++i) {
    starts.push_back(kBin_m * static_cast<double>(fullest[i].second));
  }
  return starts;
}

/// Truncated squares: what is not on the surface costs the same however far it is, so that lying across two
/// surfaces doesn't pay.
double cost(const LineProblem& problem, const Pose& pose) {
  const Pose home = unmoved(problem);
  const double turn = (pose.turn - home.turn) / problem.prior.turn_rad;
  const double shift = (pose.shift - home.shift) / problem.prior.shift_m;
  double sum = turn * turn + shift * shift;
  const TurnedPose turned(pose);
  for (const LineResidual& residual : problem.residuals) {
    const double r = residual.value(turned);
    sum += std::min(r * r, kBound * kBound);
  }
  return sum;
}

/// The best of the fits from several starts, on a scale that tells a wall from what hangs or stands before
/// it. A line half of which is hidden by a curtain lies on the wall or on the curtain then, never across.
Pose choose_surface(LineProblem problem) {
  const Pose home = unmoved(problem);
  for (LineResidual& residual : problem.residuals) {
    residual.sigma = std::hypot(residual.sigma, kTypicalUnevenness_m);
  }
  std::vector<Pose> candidates;
  for (const double offset : start_offsets(problem, home)) {
    candidates.push_back(solve(problem, {home.turn, home.shift + offset}));
    candidates.push_back(solve(problem, solve(problem, {home.turn, home.shift + offset}, Loss::kCauchy)));
  }
  Pose best = home;
  double least = std::numeric_limits<double>::max();
  for (const Pose& pose : candidates) {
    const double sum = cost(problem, pose);
    if (sum < least && std::abs(pose.turn - home.turn) <= kBound * problem.prior.turn_rad) {
      least = sum;
      best = pose;
    }
  }
  return best;
}

/// What the observations of the surface at `pose` scatter beyond their sigma [m].
double unevenness(const LineProblem& problem, const Pose& pose) {
  std::vector<double> deviations;
  std::vector<double> variances;
  const TurnedPose turned(pose);
  for (const LineResidual& residual : problem.residuals) {
    const double deviation = std::abs(residual.value(turned)) * residual.sigma;
    if (deviation <= std::max(kSurface_m, 3 * residual.sigma)) {
      deviations.push_back(deviation);
      variances.push_back(residual.sigma * residual.sigma);
    }
  }
  if (deviations.empty()) {
    return kTypicalUnevenness_m;
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
  const TurnedPose turned(pose);
  const auto bounded = [&](const LineResidual& r) { return std::clamp(r.value(turned), -kBound, kBound); };
  for (std::size_t i = 0; i < problem.residuals.size(); ++i) {
    const double r = bounded(problem.residuals[i]);
    squares += r * r;
    if (i > 0 && problem.spacing[i - 1] > 0 && problem.spacing[i - 1] < kNeighbours_m) {
      products += r * bounded(problem.residuals[i - 1]);
      pairs += 1;
    }
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
  const TurnedPose turned(pose);
  for (const LineResidual& residual : problem.residuals) {
    const double r = residual.value(turned);
    const double q = r * r / (kTukeyLoss * kTukeyLoss);
    if (q < 1) {
      squares += r * r * (1 - q) * (1 - q) * (1 - q) * (1 - q);
      slopes += (1 - q) * (1 - 5 * q);
    }
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
  const std::vector<LineResidual> expected = problem.residuals;
  fit.pose = choose_surface(problem);
  for (int round = 0; round < 2; ++round) {
    problem.residuals = expected;
    fit.unevenness_m = unevenness(problem, fit.pose);
    for (LineResidual& residual : problem.residuals) {
      residual.sigma = std::hypot(residual.sigma, fit.unevenness_m);
    }
    fit.pose = solve(problem, fit.pose);
  }
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
    const TurnedPose turned(pose);
    for (const LineResidual& residual : problem.residuals) {
      const Eigen::Vector2d j(residual.by_turn(turned), residual.by_shift());
      information += j * j.transpose() / factor;
    }
  }
  const Eigen::Matrix2d covariance = information.inverse();
  return {covariance(0, 0), covariance(0, 1), covariance(1, 1)};
}

}  // namespace roomcut::refine_lines

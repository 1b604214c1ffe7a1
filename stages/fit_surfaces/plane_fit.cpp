// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/plane_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace roomcut::fit_surfaces {
namespace {

constexpr double kTukey = 4.685;
constexpr double kCauchy = 2.385;  // wide: finds the way from a bad start
constexpr double kMadToSigma = 1.4826;
constexpr double kLargestUnevenness_m = 0.03;
constexpr double kTypicalUnevenness_m = 0.001;
constexpr double kSurface_m = 0.002;  // scale on which the best of several starts is told
constexpr double kGradientPrior = 0.02;
constexpr double kSmallestShare = 0.02;
constexpr double kFlattest = 0.3;  // mean slope of the loss
constexpr int kIterations = 50;
constexpr int kRounds = 3;

enum class Loss { kWide, kSharp };

double weight(double r, Loss loss) {
  const double u = r / (loss == Loss::kWide ? kCauchy : kTukey);
  if (loss == Loss::kWide) {
    return 1 / (1 + u * u);
  }
  return std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0;
}

/// Derivative of r · weight(r, Loss::kSharp).
double slope(double r) {
  const double q = r * r / (kTukey * kTukey);
  return q < 1 ? (1 - q) * (1 - 5 * q) : 0;
}

/// Weighted median; shares as weights.
double median(std::vector<std::pair<double, double>> values) {
  std::sort(values.begin(), values.end());
  double all = 0;
  for (const auto& [value, share] : values) {
    all += share;
  }
  double below = 0;
  for (const auto& [value, share] : values) {
    below += share;
    if (below >= 0.5 * all) {
      return value;
    }
  }
  return values.empty() ? 0 : values.back().first;
}

using Samples = std::span<const Sample>;

Eigen::Vector3d jacobian(const PlaneFit& fit, const Sample& s) {
  const Vec2 arm = fit.tilts ? Vec2(s.at - fit.middle) : Vec2(0, 0);
  return {1, arm.x(), arm.y()};
}

/// What is known without samples: of a level surface that its gradient is none.
Eigen::Matrix3d prior(const PlaneFit& fit) {
  const double of_gradient = fit.tilts ? 1 / (kGradientPrior * kGradientPrior) : 1;
  return Eigen::Vector3d(0, of_gradient, of_gradient).asDiagonal();
}

/// Information that a sample has of its surface's height: small pieces have as much unevenness as large ones.
double information(const Sample& s, double uneven) {
  return 1 / (s.variance_m2 + uneven * uneven / std::max(s.share, kSmallestShare));
}

/// Iterated reweighted least squares from `fit` on.
void solve(Samples samples, Loss loss, PlaneFit& fit) {
  const double uneven2 = fit.unevenness_m * fit.unevenness_m;
  for (int i = 0; i < kIterations; ++i) {
    Eigen::Matrix3d normal = prior(fit);
    const Vec2 off = fit.gradient - fit.expected;
    Eigen::Vector3d right = -normal * Eigen::Vector3d(0, off.x(), off.y());
    for (const Sample& s : samples) {
      const double r = s.z - fit.height(s.at);
      const double w =
          information(s, fit.unevenness_m) * weight(r / std::sqrt(s.variance_m2 + uneven2), loss);
      const Eigen::Vector3d j = jacobian(fit, s);
      normal += w * j * j.transpose();
      right += w * r * j;
    }
    if (!(normal(0, 0) > 0)) {
      return;  // nothing within reach of the loss
    }
    const Eigen::Vector3d change = normal.ldlt().solve(right);
    fit.z += change(0);
    fit.gradient += change.tail<2>();
    if (std::abs(change(0)) + change.tail<2>().norm() < 1e-9) {
      return;
    }
  }
}

std::vector<double> residuals_of(Samples samples, const PlaneFit& fit) {
  std::vector<double> residuals;
  residuals.reserve(samples.size());
  for (const Sample& s : samples) {
    residuals.push_back(s.z - fit.height(s.at));
  }
  return residuals;
}

/// Heights at which the surface may lie over the middle: the median, and the two fullest 3 mm, of what the
/// samples are above the expected gradient; those nearly equal once.
std::vector<double> start_heights(Samples samples, const PlaneFit& home) {
  constexpr double kBin_m = 0.003;
  std::vector<std::pair<double, double>> heights;
  std::map<long, double> bins;
  for (const Sample& s : samples) {
    heights.emplace_back(s.z - home.expected.dot(s.at - home.middle), s.share);
    bins[std::lround(heights.back().first / kBin_m)] += s.share;
  }
  std::vector<std::pair<double, long>> fullest;
  for (const auto& [bin, share] : bins) {
    const auto next = bins.find(bin + 1);
    fullest.emplace_back(-share - (next == bins.end() ? 0 : next->second), bin);
  }
  std::sort(fullest.begin(), fullest.end());
  std::vector<double> starts{median(heights)};
  for (std::size_t i = 0; i < std::min<std::size_t>(2, fullest.size()); ++i) {
    const double start = kBin_m * (static_cast<double>(fullest[i].second) + 0.5);
    const auto is_near = [start](double other) { return std::abs(start - other) < 0.5 * kBin_m; };
    if (std::none_of(starts.begin(), starts.end(), is_near)) {
      starts.push_back(start);
    }
  }
  return starts;
}

/// How many times its own a variance can be that was measured on n independent patches: by chi square's lower
/// 2.5 % (Wilson and Hilferty); below two patches, any.
double largest_ratio(double n) {
  const double q = 2 / (9 * n);
  const double root = 1 - q - 1.96 * std::sqrt(q);
  return root > 0 ? 1 / (root * root * root) : std::numeric_limits<double>::infinity();
}

void measure_rms(Samples samples, PlaneFit& fit) {
  double squares = 0;
  double shares = 0;
  for (const Sample& s : samples) {
    const double r = s.z - fit.height(s.at);
    if (std::abs(r) < kTukey * std::sqrt(s.variance_m2 + fit.unevenness_m * fit.unevenness_m)) {
      squares += s.share * r * r;
      shares += s.share;
    }
  }
  fit.rms_m = shares > 0 ? std::sqrt(squares / shares) : 0;
}

/// A fit from one start. A wide loss first finds the way to a tilt.
PlaneFit fit_from(Samples samples, PlaneFit fit, Loss first) {
  fit.unevenness_m =
      first == Loss::kSharp ? kTypicalUnevenness_m : unevenness(samples, residuals_of(samples, fit));
  solve(samples, first, fit);
  for (int round = 0; round < kRounds; ++round) {
    fit.unevenness_m = unevenness(samples, residuals_of(samples, fit));
    solve(samples, Loss::kSharp, fit);
  }
  return fit;
}

PlaneFit fit_plane(Samples samples, PlaneFit home) {
  home.gradient = home.expected;
  PlaneFit best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const PlaneFit& fit) {
    const double cost =
        truncated_cost(samples, kSurface_m, [&](const Sample& s) { return s.z - fit.height(s.at); });
    if (cost < least) {
      least = cost;
      best = fit;
    }
  };
  for (const double start : start_heights(samples, home)) {
    home.z = start;
    consider(fit_from(samples, home, Loss::kSharp));
    if (home.tilts) {
      consider(fit_from(samples, home, Loss::kWide));
    }
  }
  measure_rms(samples, best);
  return best;
}

}  // namespace

double unevenness(Samples samples, const std::vector<double>& residuals) {
  std::vector<std::pair<double, double>> deviations;
  std::vector<std::pair<double, double>> variances;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    deviations.emplace_back(std::abs(residuals[i]), samples[i].share);
    variances.emplace_back(samples[i].variance_m2, samples[i].share);
  }
  const double spread = kMadToSigma * median(std::move(deviations));
  return std::min(kLargestUnevenness_m,
                  std::sqrt(std::max(0.0, spread * spread - median(std::move(variances)))));
}

double patches(Samples samples) {
  double sum = 0;
  for (const Sample& s : samples) {
    sum += s.share;
  }
  return sum;
}

PlaneFit fit_level(Samples samples, const Vec2& middle) {
  PlaneFit home;
  home.middle = middle;
  return fit_plane(samples, home);
}

PlaneFit fit_tilted(Samples samples, const Vec2& middle, const Vec2& expected) {
  PlaneFit home;
  home.middle = middle;
  home.tilts = true;
  home.expected = expected;
  return fit_plane(samples, home);
}

void measure_covariance(Samples samples, const Roughness& roughness, PlaneFit& fit) {
  constexpr double kFewestBlocks = 8;
  const double own = std::max(fit.unevenness_m, kTypicalUnevenness_m);
  const double together = std::clamp(roughness.patches, 1.0, std::max(1.0, patches(samples)));
  const double rough =
      std::min(roughness.variance_m2, own * own * largest_ratio(patches(samples) / together));
  const double uneven = std::sqrt(std::max(own * own, together * rough));
  Eigen::Matrix3d normal = prior(fit);
  Eigen::Matrix3d apart = prior(fit);  // as if each patch erred alone
  double slopes = 0;
  double all = 0;
  for (const Sample& s : samples) {
    const Eigen::Vector3d j = jacobian(fit, s);
    normal += information(s, uneven) * j * j.transpose();
    apart += information(s, own) * j * j.transpose();
    const double r = s.z - fit.height(s.at);
    slopes += information(s, own) * slope(r / std::sqrt(s.variance_m2 + own * own));
    all += information(s, own);
  }
  // The loss answers a shift of the samples by less than squares would.
  const Eigen::Matrix3d apart_inverse = apart.inverse() / std::clamp(slopes / all, kFlattest, 1.0);
  const Eigen::Matrix3d expected = normal.inverse();
  Eigen::Matrix3d largest = expected;
  for (const double edge : {0.5, 1.0, 2.0, 4.0}) {
    std::map<std::pair<long, long>, Eigen::Vector3d> scores;
    for (const Sample& s : samples) {
      const double r = s.z - fit.height(s.at);
      const double sigma = std::sqrt(s.variance_m2 + own * own);
      const auto block =
          std::pair{std::lround(std::floor(s.at.x() / edge)), std::lround(std::floor(s.at.y() / edge))};
      const auto found = scores.try_emplace(block, Eigen::Vector3d::Zero()).first;
      found->second += information(s, own) * weight(r / sigma, Loss::kSharp) * r * jacobian(fit, s);
    }
    const double blocks = static_cast<double>(scores.size());
    if (blocks < kFewestBlocks) {
      break;
    }
    Eigen::Matrix3d middle = Eigen::Matrix3d::Zero();
    for (const auto& [block, score] : scores) {
      middle += score * score.transpose();
    }
    const double parameters = fit.tilts ? 3 : 1;
    const double few = blocks / (blocks - parameters) * (1 + 2 / blocks);  // as Student's t
    const Eigen::Matrix3d measured = few * apart_inverse * middle * apart_inverse;
    if ((measured - largest).trace() > 0 || measured(0, 0) > largest(0, 0)) {
      // Each parameter's larger variance; correlations are those of the larger height.
      Eigen::Matrix3d joined = measured(0, 0) > largest(0, 0) ? measured : largest;
      for (int i = 0; i < 3; ++i) {
        joined(i, i) = std::max(measured(i, i), largest(i, i));
      }
      largest = joined;
    }
  }
  fit.covariance = largest;
}

}  // namespace roomcut::fit_surfaces

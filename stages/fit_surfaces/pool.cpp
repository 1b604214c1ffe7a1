// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/pool.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace roomcut::fit_surfaces {
namespace {

constexpr double kOther = 3;  // standard deviations
constexpr double kMadToSigma = 1.4826;
constexpr double kMost = 0.6;
constexpr int kRounds = 20;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Common {
  double mean = 0, variance_of_mean = 0;
  double spread2 = 0;  // variance of the true heights about it
};

bool belongs(const PooledHeight& h, const Common& common) {
  return std::abs(h.z - common.mean) <= kOther * std::sqrt(h.sigma * h.sigma + common.spread2);
}

/// Sums over the heights that belong.
struct Moments {
  double count = 0, weights = 0, mean = 0;
  double misfit = 0;   ///< squared distances from the mean in standard deviations
  double squares = 0;  ///< what misfit loses per growth of spread2
};

Moments moments_of(const std::vector<PooledHeight>& heights, const Common& common) {
  Moments m;
  double sum = 0;
  const auto weight = [&](const PooledHeight& h) { return 1 / (h.sigma * h.sigma + common.spread2); };
  for (const PooledHeight& h : heights) {
    if (belongs(h, common)) {
      m.count += 1;
      m.weights += weight(h);
      sum += weight(h) * h.z;
    }
  }
  m.mean = m.weights > 0 ? sum / m.weights : common.mean;
  for (const PooledHeight& h : heights) {
    if (belongs(h, common)) {
      const double part = weight(h) * (h.z - m.mean) * (h.z - m.mean);
      m.misfit += part;
      m.squares += weight(h) * part;
    }
  }
  return m;
}

/// One height for most, when these scatter about it no more than by chance; else from the median and its
/// deviations on the spread at which they do (Paule and Mandel's estimate, by Newton's steps).
Common find_common(const std::vector<PooledHeight>& heights) {
  std::vector<double> values;
  for (const PooledHeight& h : heights) {
    values.push_back(h.z);
  }
  const double middle = median(values);
  for (double& value : values) {
    value = std::abs(value - middle);
  }
  Common common{middle, 0, 0};
  for (int round = 0; round < kRounds; ++round) {
    common.mean = moments_of(heights, common).mean;
  }
  const Moments one = moments_of(heights, common);
  if (one.count >= kMost * static_cast<double>(heights.size()) &&
      one.misfit <= one.count - 1 + 2 * std::sqrt(2 * std::max(0.0, one.count - 1))) {
    return {one.mean, 1 / one.weights, 0};
  }
  common = {middle, 0, std::pow(kMadToSigma * median(values), 2)};
  for (int round = 0; round < kRounds; ++round) {
    const Moments m = moments_of(heights, common);
    if (m.count == 0) {
      return common;
    }
    const double step = m.squares > 0 ? (m.misfit - (m.count - 1)) / m.squares : 0;
    common = {m.mean, 1 / m.weights, std::max(0.0, common.spread2 + step)};
  }
  return common;
}

}  // namespace

void pool_heights(std::vector<PooledHeight>& heights) {
  if (heights.size() < 2) {
    return;
  }
  const Common common = find_common(heights);
  for (PooledHeight& h : heights) {
    if (!belongs(h, common)) {
      continue;
    }
    const double own = h.sigma * h.sigma;
    const double keep = own + common.spread2 > 0 ? common.spread2 / (own + common.spread2) : 1;
    h.z = common.mean + keep * (h.z - common.mean);
    const double variance = keep * own + (1 - keep) * (1 - keep) * common.variance_of_mean;
    h.sigma = std::max(std::sqrt(variance), 0.5 * h.sigma);
  }
}

}  // namespace roomcut::fit_surfaces

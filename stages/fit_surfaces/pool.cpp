// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/pool.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace roomcut::fit_surfaces {
namespace {

constexpr double kOther = 3;  // standard deviations
constexpr double kMadToSigma = 1.4826;
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

/// From the median and its deviations on: moments of those that belong (Paule and Mandel's estimate of the
/// spread, by its fixed point).
Common find_common(const std::vector<PooledHeight>& heights) {
  std::vector<double> values;
  for (const PooledHeight& h : heights) {
    values.push_back(h.z);
  }
  Common common{median(values), 0, 0};
  for (double& value : values) {
    value = std::abs(value - common.mean);
  }
  common.spread2 = std::pow(kMadToSigma * median(values), 2);
  for (int round = 0; round < kRounds; ++round) {
    double weights = 0;
    double sum = 0;
    for (const PooledHeight& h : heights) {
      if (belongs(h, common)) {
        const double w = 1 / (h.sigma * h.sigma + common.spread2);
        weights += w;
        sum += w * h.z;
      }
    }
    if (!(weights > 0)) {
      return common;
    }
    const double mean = sum / weights;
    double misfit = 0;
    double squares = 0;
    double count = 0;
    for (const PooledHeight& h : heights) {
      if (belongs(h, common)) {
        const double w = 1 / (h.sigma * h.sigma + common.spread2);
        misfit += w * (h.z - mean) * (h.z - mean);
        squares += w * w * (h.z - mean) * (h.z - mean);
        count += 1;
      }
    }
    const double step = squares > 0 ? (misfit - (count - 1)) / squares : 0;
    common = {mean, 1 / weights, std::max(0.0, common.spread2 + step)};
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

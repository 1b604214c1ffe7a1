// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/two_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace roomcut::fit_surfaces {
namespace {

constexpr double kApart_m = 0.004;
constexpr double kApart = 4;          // standard deviations
constexpr double kWindow_m = 0.0015;  // half width of what counts as one height, at first
constexpr double kNear = 3;           // standard deviations
constexpr double kFewestPatches = 2;
constexpr int kRounds = 20;

using Heights = std::vector<std::pair<double, double>>;  // z, share

/// The middle of the window that holds most, at least `apart` from `other`.
double fullest(const Heights& sorted, double half, double other, double apart) {
  double best = std::numeric_limits<double>::quiet_NaN();
  double most = 0;
  double inside = 0;
  double sum = 0;
  std::size_t first = 0;
  for (const auto& [z, share] : sorted) {
    inside += share;
    sum += share * z;
    for (; sorted[first].first < z - 2 * half; ++first) {
      inside -= sorted[first].second;
      sum -= sorted[first].second * sorted[first].first;
    }
    const double mean = sum / inside;
    if (inside > most && !(std::abs(mean - other) < apart)) {
      most = inside;
      best = mean;
    }
  }
  return best;
}

double usual_sigma(std::span<const Sample> samples) {
  std::vector<double> variances;
  for (const Sample& s : samples) {
    variances.push_back(s.variance_m2);
  }
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return std::sqrt(*middle);
}

/// Moves both heights to the means of what is near them.
void settle(std::span<const Sample> samples, TwoHeights& two) {
  std::vector<double> off;
  for (int round = 0; round < kRounds; ++round) {
    off.clear();
    for (const Sample& s : samples) {
      off.push_back(two.off(s));
    }
    two.unevenness_m = unevenness(samples, off);
    double share[2] = {0, 0};
    double sum[2] = {0, 0};
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Sample& s = samples[i];
      const std::size_t side = two.is_high[i] ? 1 : 0;
      const double near = kNear * std::sqrt(s.variance_m2 + two.unevenness_m * two.unevenness_m);
      if (std::abs(off[i]) <= std::max(near, kWindow_m)) {
        share[side] += s.share;
        sum[side] += s.share * s.z;
      }
    }
    two.low = share[0] > 0 ? sum[0] / share[0] : two.low;
    two.high = share[1] > 0 ? sum[1] / share[1] : two.high;
    bool moved = false;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const bool high = std::abs(samples[i].z - two.high) < std::abs(samples[i].z - two.low);
      moved = moved || high != two.is_high[i];
      two.is_high[i] = high;
    }
    if (!moved) {
      return;
    }
  }
}

}  // namespace

std::optional<TwoHeights> find_two_heights(std::span<const Sample> samples) {
  if (samples.empty()) {
    return {};
  }
  Heights sorted;
  for (const Sample& s : samples) {
    sorted.emplace_back(s.z, s.share);
  }
  std::sort(sorted.begin(), sorted.end());
  const double sigma = usual_sigma(samples);
  const double half = std::max(kWindow_m, 2 * sigma);
  const double apart = std::max(kApart_m, kApart * sigma);
  const double one = fullest(sorted, half, std::numeric_limits<double>::quiet_NaN(), 0);
  const double other = fullest(sorted, half, one, apart);
  if (std::isnan(other)) {
    return {};
  }
  TwoHeights two{std::min(one, other), std::max(one, other), 0, {}};
  for (const Sample& s : samples) {
    two.is_high.push_back(std::abs(s.z - two.high) < std::abs(s.z - two.low));
  }
  settle(samples, two);
  const double scatter = std::hypot(sigma, two.unevenness_m);
  double low = 0;
  double high = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (std::abs(two.off(samples[i])) <= std::max(kNear * scatter, kWindow_m)) {
      (two.is_high[i] ? high : low) += samples[i].share;
    }
  }
  if (two.high - two.low < std::max(kApart_m, kApart * scatter) || std::min(low, high) < kFewestPatches) {
    return {};
  }
  return two;
}

}  // namespace roomcut::fit_surfaces

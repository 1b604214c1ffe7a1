// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/find_openings/robust_position.h"

#include <algorithm>
#include <cmath>

namespace roomcut::find_openings {

namespace {

/// Mean count of the bins [low, high), as far as there are any.
double mean_count(std::span<const std::uint64_t> profile, double low, double high) {
  const double last = static_cast<double>(profile.size());
  const auto begin = static_cast<std::size_t>(std::clamp(std::ceil(low), 0.0, last));
  const auto end = static_cast<std::size_t>(std::clamp(std::floor(high), 0.0, last));
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) {
    sum += BinSum::count(profile[i]);
  }
  return end > begin ? sum / static_cast<double>(end - begin) : 0.0;
}

struct Moments {
  double weight = 0, sum = 0;
  double points = 0;  // less what lies evenly
};

/// Points about `at`, with biweights.
Moments weigh(std::span<const std::uint64_t> profile, double at, double reach) {
  constexpr double kBackground = 15;  // bins
  const double below = mean_count(profile, at - reach - kBackground, at - reach);
  const double above = mean_count(profile, at + reach, at + reach + kBackground);
  Moments moments;
  const double last = static_cast<double>(profile.size());
  const auto begin = static_cast<std::size_t>(std::clamp(std::floor(at - reach), 0.0, last));
  const auto end = static_cast<std::size_t>(std::clamp(std::ceil(at + reach), 0.0, last));
  for (std::size_t i = begin; i < end; ++i) {
    if (profile[i] == 0) {
      continue;
    }
    const double x = static_cast<double>(i) + BinSum::mean(profile[i]);
    const double u = (x - at) / reach;
    const double count = BinSum::count(profile[i]) - (u < 0 ? below : above);
    if (std::abs(u) < 1) {
      const double w = (1 - u * u) * (1 - u * u) * count;
      moments.weight += w;
      moments.sum += w * x;
      moments.points += count;
    }
  }
  return moments;
}

double mean_position(std::span<const std::uint64_t> profile, std::size_t start, std::size_t window) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = start >= window ? start - window : 0; i < std::min(profile.size(), start + window + 1);
       ++i) {
    if (profile[i] != 0) {
      sum += BinSum::count(profile[i]) * (static_cast<double>(i) + BinSum::mean(profile[i]));
      count += BinSum::count(profile[i]);
    }
  }
  return count > 0 ? sum / count : static_cast<double>(start) + 0.5;
}

}  // namespace

RobustPosition robust_position(std::span<const std::uint64_t> profile, std::size_t start, std::size_t window,
                               double reach, double noise) {
  constexpr int kRounds = 50;
  constexpr double kAtRest = 1e-4;        // bins
  constexpr double kBiweightLoss = 1.05;  // of the mean's efficiency
  RobustPosition result{mean_position(profile, start, window), 0, 0};
  for (int round = 0; round < kRounds; ++round) {
    const Moments moments = weigh(profile, result.at, reach);
    if (!(moments.weight > 0) || moments.points < 1) {
      return {result.at, 0, 0};
    }
    const double before = result.at;
    result.at = std::clamp(moments.sum / moments.weight, 0.0, static_cast<double>(profile.size()));
    result.points = static_cast<std::uint32_t>(moments.points);
    if (std::abs(result.at - before) < kAtRest) {
      break;
    }
  }
  result.sigma = kBiweightLoss * noise / std::sqrt(static_cast<double>(result.points));
  return result;
}

}  // namespace roomcut::find_openings

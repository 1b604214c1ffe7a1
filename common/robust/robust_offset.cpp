// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/robust/robust_offset.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace roomcut {

namespace {

constexpr double kTukey = 3.5;  ///< cut-off in standard deviations
/// Variance of the biweight's location relative to the mean's, for normal noise and kTukey: E[psi^2] /
/// E[psi']^2. The unit test integrates it again.
constexpr double kTukeyVariance = 1.166;
constexpr double kModeWindow = 2.0;  ///< half width of the first window in standard deviations
constexpr int kIterations = 30;

/// A bin that holds points.
struct Bin {
  int place;
  double offset;
  std::uint32_t count;
};

/// Centre of the fullest window; of equal ones that nearest to 0. There must be a bin.
double fullest_window(const std::vector<Bin>& bins, double width_m, double noise_m) {
  const int reach = std::max(1, static_cast<int>(std::lround(kModeWindow * noise_m / width_m)));
  double best_offset = 0;
  std::uint64_t best_count = 0;
  auto first = bins.begin();
  for (int centre = bins.front().place; centre <= bins.back().place; ++centre) {
    std::uint64_t count = 0;
    double sum = 0;
    while (first != bins.end() && first->place < centre - reach) {
      ++first;
    }
    for (auto bin = first; bin != bins.end() && bin->place <= centre + reach; ++bin) {
      count += bin->count;
      sum += bin->count * bin->offset;
    }
    const double offset = count > 0 ? sum / static_cast<double>(count) : 0;
    if (count > best_count || (count == best_count && std::abs(offset) < std::abs(best_offset))) {
      best_count = count;
      best_offset = offset;
    }
  }
  return best_offset;
}

}  // namespace

double OffsetHistogram::mean(std::uint64_t packed) {
  const std::uint64_t sum = packed & ((std::uint64_t{1} << kSumBits) - 1);
  return static_cast<double>(sum) / (static_cast<double>(count(packed)) * (kSteps - 1));
}

RobustOffset robust_offset(std::span<const std::uint64_t> histogram, double half_m, double noise_m) {
  const double width = 2 * half_m / static_cast<double>(histogram.size());
  const double noise = std::max(noise_m, 0.5 * width);
  std::vector<Bin> bins;
  for (std::size_t k = 0; k < histogram.size(); ++k) {
    const std::uint64_t packed = histogram[k];
    const std::uint32_t count = OffsetHistogram::count(packed);
    if (count > 0) {
      const double offset = -half_m + (static_cast<double>(k) + OffsetHistogram::mean(packed)) * width;
      bins.push_back({static_cast<int>(k), offset, count});
    }
  }
  if (bins.empty()) {
    return {};
  }
  const double cut = kTukey * noise;
  double location = fullest_window(bins, width, noise);
  RobustOffset result;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    double weights = 0;
    double sum = 0;
    double squares = 0;
    std::uint32_t inside = 0;
    for (const Bin& bin : bins) {
      const double u = (bin.offset - location) / cut;
      if (std::abs(u) < 1) {
        const double weight = bin.count * (1 - u * u) * (1 - u * u);
        weights += weight;
        sum += weight * bin.offset;
        squares += bin.count * (bin.offset - location) * (bin.offset - location);
        inside += bin.count;
      }
    }
    if (inside == 0) {
      return {};
    }
    const double next = sum / weights;
    const bool settled = std::abs(next - location) < 1e-7;
    location = next;
    result = {location, kTukeyVariance * noise * noise / inside, squares / inside, inside};
    if (settled) {
      break;
    }
  }
  return result;
}

}  // namespace roomcut

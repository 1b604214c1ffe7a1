// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/estimates.h"

#include <algorithm>
#include <cmath>

namespace roomcut {

void LogHistogram::add(double value, std::uint64_t weight) {
  const double position = value > 0 ? std::floor(std::log2(value) * kPerOctave) : kLowest;
  const int bin = static_cast<int>(std::clamp(position, double{kLowest}, double{kHighest - 1})) - kLowest;
  bins_[static_cast<std::size_t>(bin)] += weight;
  total_ += weight;
}

void LogHistogram::add(const LogHistogram& other) {
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    bins_[i] += other.bins_[i];
  }
  total_ += other.total_;
}

double LogHistogram::median() const {
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    if (2 * (below + bins_[i]) >= total_ && bins_[i] > 0) {
      const double inside =
          (0.5 * static_cast<double>(total_) - static_cast<double>(below)) / static_cast<double>(bins_[i]);
      return std::exp2((kLowest + static_cast<double>(i) + inside) / kPerOctave);
    }
    below += bins_[i];
  }
  return 0;
}

}  // namespace roomcut

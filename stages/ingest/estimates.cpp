// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/estimates.h"

namespace roomcut::ingest {

void LogHistogram::add(const LogHistogram& other) {
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    bins_[i] += other.bins_[i];
  }
  total_ += other.total_;
}

double LogHistogram::edge(std::size_t bin) {
  return std::bit_cast<float>((static_cast<std::uint32_t>(bin) + kFirstBin) << kDroppedBits);
}

double LogHistogram::median() const {
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    if (2 * (below + bins_[i]) >= total_ && bins_[i] > 0) {
      const double share =
          (0.5 * static_cast<double>(total_) - static_cast<double>(below)) / static_cast<double>(bins_[i]);
      return edge(i) + share * (edge(i + 1) - edge(i));
    }
    below += bins_[i];
  }
  return 0;
}

LogHistogram LogHistogram::below(double limit) const {
  LogHistogram part;
  for (std::size_t i = 0; i < bins_.size() && edge(i + 1) <= limit; ++i) {
    part.bins_[i] = bins_[i];
    part.total_ += bins_[i];
  }
  return part;
}

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/divisions.h"

#include <algorithm>
#include <cmath>

namespace roomcut::weigh_faces {

Divisions::Divisions(const std::vector<double>& breaks, double bin, double margin)
    : breaks_(breaks), step_(bin / 2), per_step_(1 / step_) {
  first_.push_back(0);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double inset = std::min(margin, 0.2 * (breaks[i + 1] - breaks[i]));
    const double start = breaks[i] + inset;
    const double length = breaks[i + 1] - breaks[i] - 2 * inset;
    const int count = std::max(1, static_cast<int>(std::lround(length / bin)));
    for (int k = 0; k < count; ++k) {
      low_.push_back(start + length * k / count);
      high_.push_back(start + length * (k + 1) / count);
    }
    first_.push_back(bins());
  }
  if (bins() == 0) {
    return;
  }
  const auto steps = static_cast<std::size_t>((breaks_.back() - breaks_.front()) / step_) + 1;
  std::int32_t at = 0;
  for (std::size_t s = 0; s < steps; ++s) {
    while (at < bins() && high(at) <= breaks_.front() + step_ * static_cast<double>(s)) {
      ++at;
    }
    hint_.push_back(at);
  }
}

int Divisions::find(double x) const {
  if (bins() == 0 || !(x >= breaks_.front()) || !(x < breaks_.back())) {
    return -1;
  }
  const auto step = std::min(static_cast<std::size_t>((x - breaks_.front()) * per_step_), hint_.size() - 1);
  int at = std::max(0, hint_[step] - 1);  // one back: rounding of the step
  while (at < bins() && high(at) <= x) {
    ++at;
  }
  return at < bins() && low(at) <= x ? at : -1;
}

Divisions::Range Divisions::interval_of(double x) const {
  const auto next = std::upper_bound(breaks_.begin(), breaks_.end(), x);
  if (next == breaks_.begin() || next == breaks_.end()) {
    return {0, 0};
  }
  const auto i = static_cast<std::size_t>(next - breaks_.begin()) - 1;
  return {first_[i], first_[i + 1]};
}

}  // namespace roomcut::weigh_faces

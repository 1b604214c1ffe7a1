// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/upward.h"

#include <algorithm>
#include <cmath>

namespace roomcut::detect_lines {
namespace {

constexpr double kBin_m = 0.5;
constexpr double kAround_m = 0.6;  // far enough for the wall that a cupboard stands at
constexpr double kGoesOn = 0.4;

}  // namespace

Upward::Upward(const WallCells& cells, double tau_m) : cells_(cells), tau_m_(tau_m) {
  by_place_.reserve(cells.size());
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    by_place_.emplace_back(key_of(cells.slice[i], cells.x[i], cells.y[i]), i);
    slices_ = std::max(slices_, cells.slice[i] + 1);
  }
  std::sort(by_place_.begin(), by_place_.end());
}

Upward::Key Upward::key_of(std::int32_t slice, double x, double y) const {
  const auto bin = [](double m) { return static_cast<std::int32_t>(std::floor(m / kBin_m)); };
  return {slice, {bin(y), bin(x)}};
}

Upward::Seen Upward::look(const Line2& line, double t0, double t1, std::int32_t slice) const {
  const Vec2 margin = Vec2::Constant(kAround_m);
  const Vec2 low = line.at(t0).cwiseMin(line.at(t1)) - margin;
  const Vec2 high = line.at(t0).cwiseMax(line.at(t1)) + margin;
  std::vector<std::uint8_t> covered(static_cast<std::size_t>(std::ceil((t1 - t0) / tau_m_)) + 1, 0);
  Seen seen{0, false};
  const Key first = key_of(slice, low.x(), low.y());
  const Key last = key_of(slice, high.x(), high.y());
  for (std::int32_t row = first.second.first; row <= last.second.first; ++row) {
    const Key from{slice, {row, first.second.second}};
    const Key to{slice, {row, last.second.second}};
    for (auto it = std::lower_bound(by_place_.begin(), by_place_.end(), std::pair{from, std::uint32_t{0}});
         it != by_place_.end() && it->first <= to; ++it) {
      const Vec2 p(cells_.x[it->second], cells_.y[it->second]);
      const double t = line.along(p);
      if (std::abs(line.distance(p)) < tau_m_ && t >= t0 && t <= t1) {
        covered[static_cast<std::size_t>((t - t0) / tau_m_)] = 1;
      } else {
        seen.around = true;
      }
    }
  }
  const auto bins = static_cast<double>(std::count(covered.begin(), covered.end(), 1));
  seen.share = bins * tau_m_ / std::max(t1 - t0, tau_m_);
  return seen;
}

bool Upward::reaches_ceiling(const Line2& line, double t0, double t1, std::int32_t slice) const {
  for (std::int32_t above = slice + 1; above < slices_; ++above) {
    const Seen seen = look(line, t0, t1, above);
    if (seen.share < kGoesOn) return !seen.around;
  }
  return true;
}

}  // namespace roomcut::detect_lines

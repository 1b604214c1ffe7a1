// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/hough.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomcut {
namespace {

constexpr double kVoteUnit = 2e-4;  // m; half votes stay whole numbers of 0.1 mm
constexpr std::int32_t kSuppressed = -(1 << 30);

}  // namespace

HoughAccumulator::HoughAccumulator(const Vec2& centre, double radius_m, double angle_step,
                                   double distance_step)
    : centre_(centre), radius_(radius_m + 2 * distance_step), distance_step_(distance_step) {
  angles_ = static_cast<std::size_t>(std::ceil(std::numbers::pi / angle_step));
  angle_step_ = std::numbers::pi / static_cast<double>(angles_);
  distances_ = static_cast<std::size_t>(std::ceil(2 * radius_ / distance_step)) + 1;
  for (std::size_t a = 0; a < angles_; ++a)
    normals_.push_back(Line2{static_cast<double>(a) * angle_step_, 0}.normal());
  votes_.assign(angles_ * distances_, 0);
  best_.assign(angles_, Best{});
}

void HoughAccumulator::vote(const Vec2& p, double theta, double window, double weight_m, int sign) {
  const auto half = static_cast<std::int32_t>(std::lround(0.5 * weight_m / kVoteUnit)) * sign;
  const auto middle = static_cast<std::ptrdiff_t>(std::lround(theta / angle_step_));
  const auto reach = static_cast<std::ptrdiff_t>(std::floor(window / angle_step_));
  const auto n = static_cast<std::ptrdiff_t>(angles_);
  const Vec2 arm = p - centre_;
  for (std::ptrdiff_t a = middle - reach; a <= middle + reach; ++a) {
    const auto angle = static_cast<std::size_t>((a % n + n) % n);
    const double position = (normals_[angle].dot(arm) + radius_) / distance_step_;
    const auto bin = static_cast<std::size_t>(std::clamp(position, 1.0, static_cast<double>(distances_) - 2));
    std::int32_t* row = &votes_[angle * distances_ + bin];
    row[-1] += half;
    row[0] += 2 * half;
    row[1] += half;
    // Votes that are taken back elsewhere leave the highest bin where it was.
    const std::size_t highest = best_[angle].distance;
    best_[angle].stale |= half > 0 || (highest + 1 >= bin && highest <= bin + 1);
  }
}

HoughAccumulator::Peak HoughAccumulator::peak() {
  std::size_t top = 0;
  for (std::size_t a = 0; a < angles_; ++a) {
    if (best_[a].stale) {
      const auto row = votes_.begin() + static_cast<std::ptrdiff_t>(a * distances_);
      const auto highest = std::max_element(row, row + static_cast<std::ptrdiff_t>(distances_));
      best_[a] = {*highest, static_cast<std::size_t>(highest - row), false};
    }
    if (best_[a].votes > best_[top].votes) top = a;
  }
  const double theta = static_cast<double>(top) * angle_step_;
  const double offset = (static_cast<double>(best_[top].distance) + 0.5) * distance_step_ - radius_;
  return {
      {theta, offset + normals_[top].dot(centre_)}, best_[top].votes * kVoteUnit, top, best_[top].distance};
}

void HoughAccumulator::suppress(const Peak& peak) {
  votes_[peak.angle * distances_ + peak.distance] = kSuppressed;
  best_[peak.angle].stale = true;
}

double HoughAccumulator::highest_m(std::size_t angle, std::size_t begin, std::size_t end) const {
  const auto row = votes_.begin() + static_cast<std::ptrdiff_t>(angle * distances_);
  return *std::max_element(row + static_cast<std::ptrdiff_t>(begin), row + static_cast<std::ptrdiff_t>(end)) *
         kVoteUnit;
}

}  // namespace roomcut

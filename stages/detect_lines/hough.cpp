// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/hough.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomcut::detect_lines {
namespace {

constexpr double kVoteUnit = 2e-4;  // m; half votes stay whole numbers of 0.1 mm
constexpr std::int32_t kSuppressed = -(1 << 30);
constexpr std::size_t kBlock = 256;  // distances in a block

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
  blocks_ = (distances_ + kBlock - 1) / kBlock;
  best_.assign(angles_, Best{});
  block_best_.assign(angles_ * blocks_, Best{});
}

void HoughAccumulator::vote(const Vec2& p, double theta, double window, double weight_m, int sign) {
  const auto half = static_cast<std::int32_t>(std::lround(0.5 * weight_m / kVoteUnit)) * sign;
  const auto middle = static_cast<std::ptrdiff_t>(std::lround(theta / angle_step_));
  const auto reach = static_cast<std::ptrdiff_t>(std::floor(window / angle_step_));
  const auto n = static_cast<std::ptrdiff_t>(angles_);
  const Vec2 arm = p - centre_;
  auto angle = static_cast<std::size_t>(((middle - reach) % n + n) % n);
  for (std::ptrdiff_t a = -reach; a <= reach; ++a, angle = angle + 1 < angles_ ? angle + 1 : 0) {
    const double position = (normals_[angle].dot(arm) + radius_) / distance_step_;
    const auto bin = static_cast<std::size_t>(std::clamp(position, 1.0, static_cast<double>(distances_) - 2));
    std::int32_t* row = &votes_[angle * distances_ + bin];
    row[-1] += half;
    row[0] += 2 * half;
    row[1] += half;
    changed(angle, bin - 1, half > 0);
    if ((bin - 1) / kBlock != (bin + 1) / kBlock) changed(angle, bin + 1, half > 0);
  }
}

/// Votes within two of `bin`, in its block, are more or fewer. Fewer elsewhere leave the highest bin where it
/// was.
void HoughAccumulator::changed(std::size_t angle, std::size_t bin, bool more) {
  Best& block = block_best_[angle * blocks_ + bin / kBlock];
  if (more || (block.distance + 2 >= bin && block.distance <= bin + 2)) {
    block.stale = true;
    best_[angle].stale = true;
  }
}

void HoughAccumulator::find_best(std::size_t angle) {
  const auto row = votes_.begin() + static_cast<std::ptrdiff_t>(angle * distances_);
  const auto blocks = block_best_.begin() + static_cast<std::ptrdiff_t>(angle * blocks_);
  for (std::size_t b = 0; b < blocks_; ++b) {
    if (!blocks[static_cast<std::ptrdiff_t>(b)].stale) continue;
    const auto begin = row + static_cast<std::ptrdiff_t>(b * kBlock);
    const auto end = row + static_cast<std::ptrdiff_t>(std::min(distances_, (b + 1) * kBlock));
    const auto highest = std::max_element(begin, end);
    blocks[static_cast<std::ptrdiff_t>(b)] = {*highest, static_cast<std::uint32_t>(highest - row), false};
  }
  best_[angle] = *std::max_element(blocks, blocks + static_cast<std::ptrdiff_t>(blocks_),
                                   [](const Best& a, const Best& b) { return a.votes < b.votes; });
}

HoughAccumulator::Peak HoughAccumulator::peak() {
  std::size_t top = 0;
  for (std::size_t a = 0; a < angles_; ++a) {
    if (best_[a].stale) find_best(a);
    if (best_[a].votes > best_[top].votes) top = a;
  }
  const double theta = static_cast<double>(top) * angle_step_;
  const double offset = (static_cast<double>(best_[top].distance) + 0.5) * distance_step_ - radius_;
  return {
      {theta, offset + normals_[top].dot(centre_)}, best_[top].votes * kVoteUnit, top, best_[top].distance};
}

Line2 HoughAccumulator::line_at(double angle, double distance) const {
  const double theta = angle * angle_step_;
  const double offset = (distance + 0.5) * distance_step_ - radius_;
  return normalised(theta, offset + Line2{theta, 0}.normal().dot(centre_));
}

void HoughAccumulator::suppress(const Peak& peak) {
  votes_[peak.angle * distances_ + peak.distance] = kSuppressed;
  changed(peak.angle, peak.distance, false);
}

double HoughAccumulator::highest_m(std::size_t angle, std::size_t begin, std::size_t end) const {
  const auto row = votes_.begin() + static_cast<std::ptrdiff_t>(angle * distances_);
  return *std::max_element(row + static_cast<std::ptrdiff_t>(begin), row + static_cast<std::ptrdiff_t>(end)) *
         kVoteUnit;
}

}  // namespace roomcut::detect_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/lean.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace roomcut::ingest {

namespace {

constexpr double kOne = 1 << 15;
constexpr int kBinShift = 4;       // 2^-15 to 2^-11
constexpr int kHalfWindow = 11;    // bins: 0.3 degrees, as noise spreads a floor's planes
constexpr int kMedianWindow = 36;  // 1 degree
constexpr int kRounds = 20;        // of moving the window to its median
constexpr double kGroupShare = 0.25;
constexpr std::uint64_t kFewestPlanes = 40;
constexpr int kWallBinShift = 5;  // 2^-15 to 2^-10
constexpr double kFarthestWall = 0.05;
constexpr double kClear = 2;  // standard errors

std::int16_t fixed(double slope) {
  return static_cast<std::int16_t>(std::lround(std::clamp(slope, -0.99, 0.99) * kOne));
}

template <std::size_t kBins>
std::uint64_t count_in(const std::array<std::uint32_t, kBins>& bins, int from, int to) {
  const auto begin = bins.begin() + std::clamp(from, 0, static_cast<int>(kBins));
  const auto end = bins.begin() + std::clamp(to, 0, static_cast<int>(kBins));
  return std::accumulate(begin, std::max(begin, end), std::uint64_t{0});
}

/// Bin in the middle of the most level group of planes, −1 when there is none.
template <std::size_t kBins>
int most_level_group(const std::array<std::uint32_t, kBins>& bins, std::uint64_t total) {
  int best = -1;
  const auto held = [&](int bin) { return count_in(bins, bin - kHalfWindow, bin + kHalfWindow + 1); };
  const int middle = static_cast<int>(kBins) / 2;
  for (int bin = 0; bin < static_cast<int>(kBins); ++bin) {
    const std::uint64_t count = held(bin);
    if (static_cast<double>(count) < kGroupShare * static_cast<double>(total)) {
      continue;
    }
    bool peak = true;
    for (int other = bin - kHalfWindow; other <= bin + kHalfWindow && peak; ++other) {
      peak = held(other) < count || (held(other) == count && other >= bin);
    }
    if (peak && (best < 0 || std::abs(bin - middle) < std::abs(best - middle))) {
      best = bin;
    }
  }
  return best;
}

/// The median of the group around `centre`, as a slope.
template <std::size_t kBins>
double median_slope(const std::array<std::uint32_t, kBins>& bins, int centre) {
  const int from = std::max(0, centre - kMedianWindow);
  const auto half = 0.5 * static_cast<double>(count_in(bins, from, centre + kMedianWindow + 1));
  double below = 0;
  for (int bin = from; bin < static_cast<int>(kBins); ++bin) {
    const double count = bins[static_cast<std::size_t>(bin)];
    if (count > 0 && below + count >= half) {
      return (bin - static_cast<int>(kBins) / 2 + (half - below) / count) * (1 << kBinShift) / kOne;
    }
    below += count;
  }
  return 0;
}

}  // namespace

PlaneLean lean_of_level(const std::array<double, 3>& normal) {
  return {fixed(normal[0] / normal[2]), fixed(normal[1] / normal[2])};
}

PlaneLean lean_of_wall(const std::array<double, 3>& normal) {
  const double level = std::hypot(normal[0], normal[1]);
  const bool turned = normal[1] < 0 || (normal[1] == 0 && normal[0] < 0);
  return {fixed((turned ? -normal[2] : normal[2]) / level), 0};
}

void LeanSums::add_level(const PlaneLean& lean) {
  const int x = (lean.x >> kBinShift) + kBins / 2;
  const int y = (lean.y >> kBinShift) + kBins / 2;
  if (x >= 0 && x < kBins && y >= 0 && y < kBins) {
    ++floors_[0][static_cast<std::size_t>(x)];
    ++floors_[1][static_cast<std::size_t>(y)];
  }
}

void LeanSums::add_wall(const PlaneLean& lean, double azimuth) {
  const int bin = (lean.x >> kWallBinShift) + kWallBins / 2;
  const int direction = static_cast<int>(azimuth / std::numbers::pi * kAzimuths);
  if (bin >= 0 && bin < kWallBins) {
    ++walls_[static_cast<std::size_t>(std::clamp(direction, 0, kAzimuths - 1))]
            [static_cast<std::size_t>(bin)];
  }
}

void LeanSums::add(const LeanSums& other) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (std::size_t i = 0; i < kBins; ++i) {
      floors_[axis][i] += other.floors_[axis][i];
    }
  }
  for (std::size_t direction = 0; direction < walls_.size(); ++direction) {
    for (std::size_t i = 0; i < kWallBins; ++i) {
      walls_[direction][i] += other.walls_[direction][i];
    }
  }
}

std::array<double, 2> LeanSums::floors() const {
  std::array<double, 2> slope{0, 0};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::uint64_t total = count_in(floors_[axis], 0, kBins);
    const int group = total < kFewestPlanes ? -1 : most_level_group(floors_[axis], total);
    if (group < 0) {
      return {0, 0};
    }
    double centre = group;
    for (int round = 0; round < kRounds; ++round) {
      slope[axis] = median_slope(floors_[axis], static_cast<int>(std::lround(centre)));
      centre = slope[axis] * kOne / (1 << kBinShift) + kBins / 2.0;
    }
  }
  return slope;
}

bool LeanSums::walls_stand_along(const std::array<double, 2>& slope) const {
  double gain = 0;  // of distance, when up is along the slope
  double squares = 0;
  for (std::size_t direction = 0; direction < walls_.size(); ++direction) {
    const double azimuth = (static_cast<double>(direction) + 0.5) * std::numbers::pi / kAzimuths;
    const double along = -(std::cos(azimuth) * slope[0] + std::sin(azimuth) * slope[1]);
    for (std::size_t bin = 0; bin < kWallBins; ++bin) {
      const double lean = (static_cast<double>(bin) + 0.5 - kWallBins / 2.0) * (1 << kWallBinShift) / kOne;
      const double less =
          std::min(std::abs(lean), kFarthestWall) - std::min(std::abs(lean - along), kFarthestWall);
      gain += walls_[direction][bin] * less;
      squares += walls_[direction][bin] * less * less;
    }
  }
  return gain > kClear * std::sqrt(squares);
}

Lean lean_of(const LeanSums& sums, const FloorFit& fit) {
  const std::array<double, 2> floors = fit.slope(sums.floors());
  const double steep = std::hypot(floors[0], floors[1]);
  const double length = std::hypot(steep, 1.0);
  Lean lean;
  lean.up = {floors[0] / length, floors[1] / length, 1 / length};
  lean.degrees = std::atan(steep) * 180 / std::numbers::pi;
  lean.walls_agree = sums.walls_stand_along(floors);
  return lean;
}

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/arc_choice.h"

#include <algorithm>
#include <cmath>

namespace roomcut::detect_lines {
namespace {

constexpr std::size_t kBinsPerSide = 3;
constexpr std::size_t kMostSides = 64;
constexpr double kFarOff = 5;            // times the median distance
constexpr double kCircleParameters = 5;  // centre, radius, both ends

/// Sums of the first bins' coordinates, from which any stretch's line is had at once.
class LineSquares {
 public:
  explicit LineSquares(const std::vector<ArcBin>& bins) : sums_(bins.size() + 1) {
    for (std::size_t i = 0; i < bins.size(); ++i) {
      const Vec2 p = bins[i].mean - bins.front().mean;
      sums_[i + 1] = sums_[i];
      sums_[i + 1].weight += bins[i].weight;
      sums_[i + 1].first += bins[i].weight * p;
      sums_[i + 1].second += bins[i].weight * p * p.transpose();
    }
  }

  /// Weighted sum of the squared distances of bins [begin, end) from their best line.
  double operator()(std::size_t begin, std::size_t end) const {
    const double n = sums_[end].weight - sums_[begin].weight;
    const Vec2 mean = (sums_[end].first - sums_[begin].first) / n;
    const Eigen::Matrix2d c = (sums_[end].second - sums_[begin].second) / n - mean * mean.transpose();
    const double half = 0.5 * (c(0, 0) + c(1, 1));
    return n * std::max(0.0, half - std::hypot(0.5 * (c(0, 0) - c(1, 1)), c(0, 1)));
  }

 private:
  struct Sums {
    double weight = 0;
    Vec2 first = Vec2::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  };
  std::vector<Sums> sums_;
};

}  // namespace

std::vector<ArcBin> without_outliers(std::vector<ArcBin> bins) {
  if (bins.empty()) return bins;
  std::vector<double> off;
  off.reserve(bins.size());
  for (const ArcBin& bin : bins) off.push_back(std::abs(bin.distance_m));
  std::sort(off.begin(), off.end());
  const double limit = std::max(kFarOff * off[off.size() / 2], off[off.size() - 1 - off.size() / 10]);
  std::erase_if(bins, [&](const ArcBin& bin) { return std::abs(bin.distance_m) > limit; });
  return bins;
}

bool circle_beats_polyline(const std::vector<ArcBin>& bins, double floor_m, double least_gain) {
  const std::size_t n = bins.size();
  if (n < 2 * kBinsPerSide) return false;
  const auto count = static_cast<double>(n);
  double weight = 0, circle = 0;
  for (const ArcBin& bin : bins) weight += bin.weight;
  const auto criterion = [&](double squares, double parameters) {
    return count * std::log(squares / weight + floor_m * floor_m) + parameters * std::log(count);
  };
  for (const ArcBin& bin : bins) circle += bin.weight * bin.distance_m * bin.distance_m;
  const double limit = criterion(circle, kCircleParameters) + least_gain;
  const LineSquares line(bins);
  std::vector<double> best(n + 1, 1e9);  // of the first bins in so many sides
  best[0] = 0;
  for (std::size_t sides = 1; sides <= std::min(kMostSides, n / kBinsPerSide); ++sides) {
    std::vector<double> next(n + 1, 1e9);
    for (std::size_t end = sides * kBinsPerSide; end <= n; ++end) {
      for (std::size_t begin = (sides - 1) * kBinsPerSide; begin + kBinsPerSide <= end; ++begin) {
        if (best[begin] < 1e9) next[end] = std::min(next[end], best[begin] + line(begin, end));
      }
    }
    best.swap(next);
    if (criterion(best[n], 2.0 * static_cast<double>(sides) + 2) < limit) return false;
  }
  return true;
}

}  // namespace roomcut::detect_lines

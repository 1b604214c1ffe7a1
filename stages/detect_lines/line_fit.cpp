// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/line_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace roomcut::detect_lines {
namespace {

constexpr int kIterations = 12;
constexpr double kConverged = 1e-7;

Vec2 position(const WallCells& cells, std::uint32_t i) {
  return {cells.x[i], cells.y[i]};
}

/// One weighted least squares step; with areas as weights the centroids stand for all points. Moments are
/// taken about the first inlier: no cancellation far from the origin.
Line2 weighted_fit(const WallCells& cells, const CellIndices& on_line, const Line2& line, double cauchy_m,
                   bool fixed_angle) {
  const Vec2 base = position(cells, on_line.front());
  double w = 0;
  Vec2 first = Vec2::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (const std::uint32_t i : on_line) {
    const double e = line.distance(position(cells, i)) / cauchy_m;
    const double weight = static_cast<double>(cells.area_m2[i]) / (1 + e * e);
    const Vec2 p = position(cells, i) - base;
    w += weight;
    first += weight * p;
    second += weight * p * p.transpose();
  }
  if (w <= 0) return line;
  const Vec2 mean = first / w;
  double theta = line.theta;
  if (!fixed_angle) {
    const Eigen::Matrix2d c = second / w - mean * mean.transpose();
    theta = 0.5 * std::atan2(2 * c(0, 1), c(0, 0) - c(1, 1)) + std::numbers::pi / 2;
    theta = line.theta + std::remainder(theta - line.theta, std::numbers::pi);
  }
  const Vec2 centre = base + mean;
  return normalised(theta, Line2{theta, 0}.normal().dot(centre));
}

struct Piece {
  double t0, t1, support_m;
};

/// Joins neighbouring pieces, again and again, until every gap is too long for its neighbours.
void join_pieces(std::vector<Piece>& pieces, double max_gap_m) {
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<Piece> joined;
    for (const Piece& piece : pieces) {
      if (!joined.empty()) {
        Piece& last = joined.back();
        const double shorter = std::min(last.support_m, piece.support_m);
        if (piece.t0 - last.t1 <= std::min(max_gap_m, 0.5 + 3 * shorter)) {
          last = {last.t0, piece.t1, last.support_m + piece.support_m};
          changed = true;
          continue;
        }
      }
      joined.push_back(piece);
    }
    pieces.swap(joined);
  }
}

using BinSums = std::map<std::int64_t, double>;

/// Every bin's sum spread evenly over the bins near it, as far as there are any: what one bin has too much by
/// chance, or by where the bins begin, its neighbours have too little.
BinSums spread_out(const BinSums& sums) {
  constexpr std::int64_t kReach = 2;
  BinSums spread;
  for (const auto& [bin, sum] : sums) {
    const auto begin = sums.lower_bound(bin - kReach);
    const auto end = sums.upper_bound(bin + kReach);
    const auto share = sum / static_cast<double>(std::distance(begin, end));
    for (auto near = begin; near != end; ++near) spread[near->first] += share;
  }
  return spread;
}

/// Covered length per bin along the line: the slice that covers it best counts.
std::map<std::int64_t, Piece> covered_bins(const WallCells& cells, const CellIndices& on_line,
                                           const Line2& line, double bin_m) {
  std::map<std::int32_t, BinSums> slices;
  std::map<std::int64_t, Piece> bins;
  for (const std::uint32_t i : on_line) {
    const double t = line.along(position(cells, i));
    const auto bin = static_cast<std::int64_t>(std::floor(t / bin_m));
    slices[cells.slice[i]][bin] += static_cast<double>(cells.weight_m[i]);
    Piece& piece = bins.try_emplace(bin, Piece{t, t, 0}).first->second;
    piece = {std::min(piece.t0, t), std::max(piece.t1, t), 0};
  }
  for (const auto& [slice, sums] : slices) {
    for (const auto& [bin, sum] : spread_out(sums)) {
      double& support = bins.at(bin).support_m;
      support = std::max(support, std::min(bin_m, sum));
    }
  }
  return bins;
}

}  // namespace

CellIndices inliers(const WallCells& cells, const CellIndices& candidates, const Line2& line,
                    const FitRules& rules, double distance_m) {
  CellIndices found;
  const Vec2 n = line.normal();
  for (const std::uint32_t i : candidates) {
    const double e =
        n.x() * static_cast<double>(cells.x[i]) + n.y() * static_cast<double>(cells.y[i]) - line.d;
    if (std::abs(e) <= distance_m &&
        angle_between(static_cast<double>(cells.theta[i]), line.theta) <= rules.inlier_angle_rad) {
      found.push_back(i);
    }
  }
  return found;
}

Line2 fit_line(const WallCells& cells, const CellIndices& candidates, Line2 start, const FitRules& rules,
               bool fixed_angle) {
  Line2 line = start;
  for (int i = 0; i < kIterations; ++i) {
    const CellIndices on_line = inliers(cells, candidates, line, rules, rules.inlier_m);
    if (on_line.size() < 2) return start;
    const Line2 next = weighted_fit(cells, on_line, line, rules.cauchy_m, fixed_angle);
    const Vec2 centre = position(cells, on_line[on_line.size() / 2]);
    const bool converged =
        angle_between(next.theta, line.theta) < kConverged &&
        std::abs(std::abs(next.distance(centre)) - std::abs(line.distance(centre))) < kConverged;
    line = next;
    if (converged) break;
  }
  return line;
}

std::vector<Support> supports(const WallCells& cells, const CellIndices& on_line, const Line2& line,
                              const FitRules& rules) {
  std::vector<Piece> pieces;
  for (const auto& [bin, piece] : covered_bins(cells, on_line, line, rules.bin_m)) pieces.push_back(piece);
  join_pieces(pieces, rules.max_gap_m);
  std::vector<Support> found;
  for (const Piece& piece : pieces) found.push_back({piece.t0, piece.t1, piece.support_m, {}});
  for (const std::uint32_t i : on_line) {
    const double t = line.along(position(cells, i));
    const auto after = std::upper_bound(found.begin(), found.end(), t,
                                        [](double at, const Support& s) { return at < s.t0; });
    (after - 1)->cells.push_back(i);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Support& a, const Support& b) { return a.support_m > b.support_m; });
  return found;
}

FitQuality quality(const WallCells& cells, const CellIndices& on_line, const Line2& line) {
  double w = 0, e1 = 0, e2 = 0, t1 = 0, t2 = 0;
  if (on_line.empty()) return {};
  const double base = line.along(position(cells, on_line.front()));
  for (const std::uint32_t i : on_line) {
    const double weight = cells.area_m2[i];
    const double e = line.distance(position(cells, i));
    const double t = line.along(position(cells, i)) - base;
    w += weight;
    e1 += weight * e;
    e2 += weight * e * e;
    t1 += weight * t;
    t2 += weight * t * t;
  }
  const auto n = static_cast<double>(on_line.size());
  FitQuality result;
  result.mean_offset_m = e1 / w;
  result.rms_m = std::sqrt(e2 / w);
  const double spread = std::sqrt(std::max(1e-12, t2 / w - t1 * t1 / (w * w)));
  result.sigma_offset_m = result.rms_m / std::sqrt(n);
  result.sigma_angle_rad = result.rms_m / (std::sqrt(n) * spread);
  return result;
}

}  // namespace roomcut::detect_lines

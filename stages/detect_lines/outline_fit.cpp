// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/outline_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomcut::detect_lines {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kRounds = 4;         // of assigning cells to sides and fitting those
constexpr double kTrimmed = 0.04;  // share of the weight beyond the first guess of a side

Vec2 position(const WallCells& cells, std::uint32_t i) {
  return {cells.x[i], cells.y[i]};
}

/// Coordinates along and across theta, from the centre.
Vec2 turned(const Outline& outline, const Vec2& p) {
  const Vec2 d = p - outline.centre;
  const double c = std::cos(outline.theta);
  const double s = std::sin(outline.theta);
  return {c * d.x() + s * d.y(), -s * d.x() + c * d.y()};
}

double cost(const WallCells& cells, const CellIndices& group, const Outline& outline, double outlier_m) {
  double sum = 0, weight = 0;
  for (const std::uint32_t i : group) {
    const double d = std::min(std::abs(outline.distance(position(cells, i))), outlier_m);
    sum += static_cast<double>(cells.area_m2[i]) * d * d;
    weight += cells.area_m2[i];
  }
  return weight > 0 ? sum / weight : outlier_m * outlier_m;
}

/// The values below and above which `kTrimmed` of the weight lies.
std::pair<double, double> trimmed_range(std::vector<std::pair<double, double>>& weighted) {
  std::sort(weighted.begin(), weighted.end());
  double all = 0;
  for (const auto& [value, weight] : weighted) all += weight;
  std::pair<double, double> range{weighted.front().first, weighted.back().first};
  double sum = 0;
  for (const auto& [value, weight] : weighted) {
    if (sum <= kTrimmed * all) range.first = value;
    sum += weight;
    if (sum >= (1 - kTrimmed) * all) {
      range.second = value;
      break;
    }
  }
  return range;
}

struct Box {
  std::array<double, 2> low{}, high{};
};

/// One step of the fit: the sides go through the mean of the cells next to them; those near a corner say
/// little.
Box refitted(const std::vector<std::array<double, 3>>& points, const Box& box, const OutlineRules& rules) {
  std::array<std::array<double, 2>, 4> sums{};  // side: low u, high u, low v, high v
  std::array<std::array<double, 2>, 4> corner{};
  for (const auto& [u, v, w] : points) {
    const std::array<double, 4> off = {u - box.low[0], box.high[0] - u, v - box.low[1], box.high[1] - v};
    std::size_t side = 0, second = 4;
    for (std::size_t k = 1; k < 4; ++k) {
      if (std::abs(off[k]) < std::abs(off[side])) side = k;
    }
    if (std::abs(off[side]) > rules.outlier_m) continue;
    for (std::size_t k = side < 2 ? 2 : 0; k < (side < 2 ? 4U : 2U); ++k) {
      if (off[k] < rules.tau_m) second = k;
    }
    auto& sum = second < 4 ? corner[side] : sums[side];
    sum[0] += w * (side < 2 ? u : v);
    sum[1] += w;
  }
  Box next = box;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& sum = sums[k][1] > 0 ? sums[k] : corner[k];
    if (sum[1] > 0) (k % 2 == 0 ? next.low : next.high)[k / 2] = sum[0] / sum[1];
  }
  return next;
}

/// As cost(), of points along and across the box's sides.
double cost(const std::vector<std::array<double, 3>>& points, const Box& box, double outlier_m) {
  double sum = 0, weight = 0;
  for (const auto& [u, v, w] : points) {
    const double over_u = std::max(box.low[0] - u, u - box.high[0]);
    const double over_v = std::max(box.low[1] - v, v - box.high[1]);
    const double d =
        over_u <= 0 || over_v <= 0 ? std::abs(std::max(over_u, over_v)) : std::hypot(over_u, over_v);
    sum += w * std::min(d, outlier_m) * std::min(d, outlier_m);
    weight += w;
  }
  return weight > 0 ? sum / weight : outlier_m * outlier_m;
}

Outline outline_of(const Box& box, double theta) {
  Outline outline;
  outline.theta = theta;
  outline.half = {0.5 * (box.high[0] - box.low[0]), 0.5 * (box.high[1] - box.low[1])};
  const double u = 0.5 * (box.high[0] + box.low[0]);
  const double v = 0.5 * (box.high[1] + box.low[1]);
  outline.centre = {std::cos(theta) * u - std::sin(theta) * v, std::sin(theta) * u + std::cos(theta) * v};
  return outline;
}

}  // namespace

double Outline::perimeter_m() const {
  return round ? 2 * std::numbers::pi * half[0] : 4 * (half[0] + half[1]);
}

double Outline::distance(const Vec2& p) const {
  if (round) return (p - centre).norm() - half[0];
  const Vec2 q = turned(*this, p);
  const double u = std::abs(q.x()) - half[0];
  const double v = std::abs(q.y()) - half[1];
  if (u <= 0 || v <= 0) return std::max(u, v);
  return std::hypot(u, v);
}

double Outline::along(const Vec2& p) const {
  const Vec2 q = turned(*this, p);
  if (round) {
    const double angle = std::atan2(q.y(), q.x());
    return half[0] * (angle < 0 ? angle + 2 * std::numbers::pi : angle);
  }
  const double u = std::clamp(q.x(), -half[0], half[0]);
  const double v = std::clamp(q.y(), -half[1], half[1]);
  const double at_u = std::abs(std::abs(q.x()) - half[0]);
  const double at_v = std::abs(std::abs(q.y()) - half[1]);
  const double a = 2 * half[0];
  const double b = 2 * half[1];
  if (at_u <= at_v) return q.x() > 0 ? v + half[1] : b + a + (half[1] - v);
  return q.y() > 0 ? b + (half[0] - u) : 2 * b + a + (u + half[0]);
}

OutlineFit fit_rectangle(const WallCells& cells, const CellIndices& group, double theta,
                         const OutlineRules& rules) {
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  std::vector<std::array<double, 3>> points;
  std::array<std::vector<std::pair<double, double>>, 2> axes;
  for (const std::uint32_t i : group) {
    const Vec2 p = position(cells, i);
    const double w = cells.area_m2[i];
    points.push_back({c * p.x() + s * p.y(), -s * p.x() + c * p.y(), w});
    axes[0].emplace_back(points.back()[0], w);
    axes[1].emplace_back(points.back()[1], w);
  }
  Box box;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::tie(box.low[axis], box.high[axis]) = trimmed_range(axes[axis]);
  }
  for (int round = 0; round < kRounds; ++round) box = refitted(points, box, rules);
  return {outline_of(box, theta), cost(points, box, rules.outlier_m)};
}

OutlineFit fit_rectangle(const WallCells& cells, const CellIndices& group, const OutlineRules& rules) {
  OutlineFit best;
  best.variance_m2 = 1e9;
  const auto try_around = [&](double middle, double step, int steps) {
    for (int k = -steps; k <= steps; ++k) {
      const OutlineFit fit = fit_rectangle(cells, group, middle + k * step, rules);
      if (fit.variance_m2 < best.variance_m2) best = fit;
    }
  };
  try_around(45 * kDegree, 3 * kDegree, 15);
  try_around(best.outline.theta, 0.75 * kDegree, 4);
  try_around(best.outline.theta, 0.15 * kDegree, 5);
  return best;
}

OutlineFit fit_circle(const WallCells& cells, const CellIndices& group, const OutlineRules& rules) {
  // Algebraic: |p|^2 = 2 c p + k. Then twice the geometric one by Gauss and Newton.
  const Vec2 base = position(cells, group.front());
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : group) {
    const Vec2 p = position(cells, i) - base;
    const Eigen::Vector3d row(2 * p.x(), 2 * p.y(), 1);
    const double w = cells.area_m2[i];
    normal += w * row * row.transpose();
    right += w * p.squaredNorm() * row;
  }
  Eigen::Vector3d x = normal.ldlt().solve(right);
  Vec2 centre = x.head<2>();
  double radius = std::sqrt(std::max(0.0, x(2) + centre.squaredNorm()));
  for (int round = 0; round < kRounds; ++round) {
    normal.setZero();
    right.setZero();
    for (const std::uint32_t i : group) {
      const Vec2 d = position(cells, i) - base - centre;
      const double r = d.norm();
      const double e = r - radius;
      if (r <= 0 || std::abs(e) > rules.outlier_m) continue;
      const Eigen::Vector3d row(d.x() / r, d.y() / r, 1);
      const double w = cells.area_m2[i];
      normal += w * row * row.transpose();
      right += w * e * row;
    }
    normal.diagonal().array() += 1e-12;
    x = normal.ldlt().solve(right);
    centre += x.head<2>();
    radius += x(2);
  }
  Outline outline;
  outline.round = true;
  outline.centre = base + centre;
  outline.half = {radius, radius};
  if (!outline.centre.allFinite() || !std::isfinite(radius)) return {{}, 1e9};
  return {outline, cost(cells, group, outline, rules.outlier_m)};
}

OutlineFit fit_same(const WallCells& cells, const CellIndices& group, const Outline& like,
                    const OutlineRules& rules) {
  Outline outline = like;
  for (int round = 0; round < 2 * kRounds; ++round) {
    // The mean of the signed distances along each axis, of the cells near the outline.
    Eigen::Matrix2d normal = Eigen::Matrix2d::Identity() * 1e-12;
    Vec2 right = Vec2::Zero();
    for (const std::uint32_t i : group) {
      const Vec2 p = position(cells, i);
      const double e = outline.distance(p);
      if (std::abs(e) > 2 * rules.outlier_m) continue;
      const Vec2 q = turned(outline, p);
      Vec2 n = q.normalized();
      if (!outline.round) {
        const bool first =
            std::abs(std::abs(q.x()) - outline.half[0]) <= std::abs(std::abs(q.y()) - outline.half[1]);
        n = first ? Vec2(q.x() > 0 ? 1 : -1, 0) : Vec2(0, q.y() > 0 ? 1 : -1);
      }
      const Vec2 world(std::cos(outline.theta) * n.x() - std::sin(outline.theta) * n.y(),
                       std::sin(outline.theta) * n.x() + std::cos(outline.theta) * n.y());
      const double w = cells.area_m2[i];
      normal += w * world * world.transpose();
      right += w * e * world;
    }
    outline.centre += normal.ldlt().solve(right);
  }
  return {outline, cost(cells, group, outline, rules.outlier_m)};
}

}  // namespace roomcut::detect_lines

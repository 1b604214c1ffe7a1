// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/column_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace roomcut::detect_lines {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSigmas = 3;
constexpr double kLargestTurn = 2.5 * kPi / 180;
constexpr double kSmallRound_m = 0.25;  // a circle of a smaller radius has 8 chords, a larger one 12

/// "c0001" of 0.
std::string column_name(std::size_t index) {
  const std::string number = std::to_string(index + 1);
  return "c" + std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number;
}

/// How far off a rectangle's direction may be [rad].
double sigma_of(const WallCells& cells, const Column& column, const OutlineRules& fit) {
  double sum = 0, weight = 0;
  for (const std::uint32_t i : column.cells) {
    const double d = std::min(fit.outlier_m, std::abs(column.outline.distance({cells.x[i], cells.y[i]})));
    sum += static_cast<double>(cells.area_m2[i]) * d * d;
    weight += cells.area_m2[i];
  }
  const double lever = 0.5 * (column.outline.half[0] + column.outline.half[1]) / std::numbers::sqrt3;
  return weight > 0 ? std::sqrt(sum / weight / static_cast<double>(column.cells.size())) / lever : 0;
}

void turn_to_walls(const WallCells& cells, double theta, const OutlineRules& fit, Column& column) {
  Outline& outline = column.outline;
  if (outline.round) return;
  const double off = std::remainder(theta - outline.theta, kPi / 2);
  if (std::abs(off) > std::min(kLargestTurn, kSigmas * sigma_of(cells, column, fit))) return;
  const double quarters = std::round((outline.theta + off - theta) / (kPi / 2));
  outline.theta = theta;
  if (std::fmod(std::abs(quarters), 2.0) > 0.5) std::swap(outline.half[0], outline.half[1]);
  outline = fit_same(cells, column.cells, outline, fit).outline;
}

/// The polygon's sides: direction of the outward normal, and distance from the centre.
std::vector<std::pair<double, double>> sides_of(const Outline& outline, double theta) {
  std::vector<std::pair<double, double>> sides;
  if (!outline.round) {
    for (const std::size_t k : {0U, 1U, 2U, 3U}) {
      sides.emplace_back(outline.theta + static_cast<double>(k) * kPi / 2, outline.half[k % 2]);
    }
    return sides;
  }
  const int n = outline.half[0] < kSmallRound_m ? 8 : 12;
  const double apothem = outline.half[0] * std::sqrt(kPi / (n * std::tan(kPi / n)));
  for (int k = 0; k < n; ++k) sides.emplace_back(theta + 2 * kPi * k / n, apothem);
  return sides;
}

std::vector<Side> all_sides(const WallCells& cells, const std::vector<Column>& columns, double theta) {
  std::vector<Side> all;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Outline& outline = columns[c].outline;
    const auto sides = sides_of(outline, theta);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto& [angle, apothem] = sides[k];
      Side side{{}, {}, column_name(c)};
      side.line = normalised(angle, Line2{angle, 0}.normal().dot(outline.centre) + apothem);
      const double half = outline.round ? apothem * std::tan(kPi / static_cast<double>(sides.size()))
                                        : outline.half[1 - k % 2];
      const double middle = side.line.along(outline.centre);
      side.support = {middle - half, middle + half, 2 * half * columns[c].seen, {}};
      for (const std::uint32_t i : columns[c].cells) {
        const Vec2 p(cells.x[i], cells.y[i]);
        if (std::abs(side.line.along(p) - middle) <= half &&
            std::abs(side.line.distance(p)) < 0.3 * std::min(outline.half[0], outline.half[1])) {
          side.support.cells.push_back(i);
        }
      }
      all.push_back(std::move(side));
    }
  }
  return all;
}

}  // namespace

std::vector<Side> sides_of_columns(const WallCells& cells, std::vector<Column> columns, double theta,
                                   const OutlineRules& fit) {
  for (Column& column : columns) turn_to_walls(cells, theta, fit, column);
  return all_sides(cells, columns, theta);
}

}  // namespace roomcut::detect_lines

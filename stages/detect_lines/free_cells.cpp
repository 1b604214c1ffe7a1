// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/free_cells.h"

#include <algorithm>
#include <cmath>

namespace roomcut::detect_lines {
namespace {

constexpr double kLeastEdge_m = 0.5;
constexpr double kRounding_m = 1e-3;  // a square more costs little, a cell too few would change the lines

std::ptrdiff_t clamped(double square, std::ptrdiff_t squares) {
  return static_cast<std::ptrdiff_t>(std::clamp(std::floor(square), 0.0, static_cast<double>(squares - 1)));
}

}  // namespace

FreeCells::FreeCells(const WallCells& cells) : cells_(cells), taken_(cells.size(), 0) {
  if (cells.size() == 0) return;
  const auto [x0, x1] = std::minmax_element(cells.x.begin(), cells.x.end());
  const auto [y0, y1] = std::minmax_element(cells.y.begin(), cells.y.end());
  low_ = {*x0, *y0};
  const std::array<double, 2> size = {*x1 - low_[0], *y1 - low_[1]};
  // Not more squares than cells, however far apart those lie.
  edge_ = std::max(kLeastEdge_m, std::sqrt(size[0] * size[1] / static_cast<double>(cells.size())));
  for (std::size_t axis = 0; axis < 2; ++axis) {
    squares_[axis] = static_cast<std::ptrdiff_t>(size[axis] / edge_) + 1;
  }
  begin_.assign(static_cast<std::size_t>(squares_[0] * squares_[1]) + 1, 0);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    if (cells.boundary[i] != 0) ++begin_[square_of(i) + 1];
  }
  for (std::size_t s = 1; s < begin_.size(); ++s) begin_[s] += begin_[s - 1];
  end_.assign(begin_.begin(), begin_.end() - 1);
  sorted_.resize(begin_.back());
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    if (cells.boundary[i] != 0) sorted_[end_[square_of(i)]++] = i;
  }
}

std::size_t FreeCells::square_of(std::uint32_t cell) const {
  const std::ptrdiff_t ix = clamped((static_cast<double>(cells_.x[cell]) - low_[0]) / edge_, squares_[0]);
  const std::ptrdiff_t iy = clamped((static_cast<double>(cells_.y[cell]) - low_[1]) / edge_, squares_[1]);
  return static_cast<std::size_t>(iy * squares_[0] + ix);
}

/// The squares that come within `reach_m` of the line, strip by strip along the axis that it follows more.
template <class Visit>
void FreeCells::for_squares(const Line2& line, double reach_m, Visit&& visit) const {
  const Vec2 normal = line.normal();
  const std::array<double, 2> n = {normal.x(), normal.y()};
  const std::size_t along = std::abs(n[0]) > std::abs(n[1]) ? 1 : 0;
  const std::size_t across = 1 - along;
  const std::array<std::ptrdiff_t, 2> stride = {1, squares_[0]};
  const double reach = (reach_m + kRounding_m) / std::abs(n[across]);
  for (std::ptrdiff_t strip = 0; strip < squares_[along]; ++strip) {
    const double begin = low_[along] + static_cast<double>(strip) * edge_;
    const auto [c0, c1] = std::minmax(
        {(line.d - n[along] * begin) / n[across], (line.d - n[along] * (begin + edge_)) / n[across]});
    const double first = (c0 - reach - low_[across]) / edge_;
    const double last = (c1 + reach - low_[across]) / edge_;
    if (last < 0 || first >= static_cast<double>(squares_[across])) continue;
    for (auto i = clamped(first, squares_[across]); i <= clamped(last, squares_[across]); ++i) {
      visit(static_cast<std::size_t>(strip * stride[along] + i * stride[across]));
    }
  }
}

CellIndices FreeCells::on_line(const Line2& line, const FitRules& rules, double distance_m) const {
  CellIndices near;
  for_squares(line, distance_m, [&](std::size_t square) {
    near.insert(near.end(), sorted_.begin() + begin_[square], sorted_.begin() + end_[square]);
  });
  CellIndices found = inliers(cells_, near, line, rules, distance_m);
  std::sort(found.begin(), found.end());
  return found;
}

void FreeCells::take(const CellIndices& taken) {
  for (const std::uint32_t i : taken) taken_[i] = 1;
  std::size_t last = end_.size();
  for (const std::uint32_t i : taken) {
    const std::size_t square = square_of(i);
    if (square == last) continue;
    last = square;
    const auto begin = sorted_.begin() + begin_[square];
    const auto end = sorted_.begin() + end_[square];
    const auto left = std::remove_if(begin, end, [&](std::uint32_t cell) { return taken_[cell] != 0; });
    end_[square] = static_cast<std::uint32_t>(left - sorted_.begin());
  }
}

}  // namespace roomcut::detect_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/line_neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace roomcut::refine_lines {

namespace {

/// Whether the strip of `half` on both sides of the line can meet the box.
bool strip_meets_box(const NearLine& line, double half, const Vec2& low, const Vec2& high) {
  const Vec2 centre = 0.5 * (low + high);
  const Vec2 reach = 0.5 * (high - low);
  const double distance = line.normal.dot(centre) - line.faces->line.d;
  const double t = line.direction.dot(centre);
  const double across = line.normal.cwiseAbs().dot(reach);
  const double along = line.direction.cwiseAbs().dot(reach);
  return std::abs(distance) <= across + half && t + along >= line.faces->t0 && t - along <= line.faces->t1;
}

void keep_near(const Vec2& low, const Vec2& high, double half, const std::vector<NearLine>& from,
               std::vector<NearLine>& to) {
  std::copy_if(from.begin(), from.end(), std::back_inserter(to),
               [&](const NearLine& line) { return strip_meets_box(line, half, low, high); });
}

}  // namespace

LineNeighbourhood::LineNeighbourhood(const CloudTile& tile, const std::vector<NearLine>& lines,
                                     double band_m) {
  if (tile.size() == 0) {
    return;
  }
  const auto [x0, x1] = std::minmax_element(tile.x.begin(), tile.x.end());
  const auto [y0, y1] = std::minmax_element(tile.y.begin(), tile.y.end());
  low_ = Vec2(*x0, *y0);
  columns_ = static_cast<std::size_t>((*x1 - *x0) / kBlock_m) + 1;
  const std::size_t rows = static_cast<std::size_t>((*y1 - *y0) / kBlock_m) + 1;
  std::vector<NearLine> of_tile;
  keep_near(low_, Vec2(*x1, *y1), band_m, lines, of_tile);
  std::vector<NearLine> of_row;
  const Vec2 rounding = Vec2::Constant(1e-6);  // a point at the rim of a block may be counted to the next
  for (std::size_t row = 0; row < rows; ++row) {
    const Vec2 corner = low_ + Vec2(0, static_cast<double>(row) * kBlock_m);
    of_row.clear();
    keep_near(corner - rounding, Vec2(*x1, corner.y() + kBlock_m) + rounding, band_m, of_tile, of_row);
    for (std::size_t column = 0; column < columns_; ++column) {
      const Vec2 low = corner + Vec2(static_cast<double>(column) * kBlock_m, 0);
      keep_near(low - rounding, low + Vec2::Constant(kBlock_m) + rounding, band_m, of_row, near_);
      end_.push_back(near_.size());
    }
  }
}

}  // namespace roomcut::refine_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/wall_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/cloud/cloud.h"

namespace roomcut::detect_lines {
namespace {

constexpr std::array<int, 3> kRadii = {2, 4, 8};  // in tau
constexpr double kTrust = 0.7;  // azimuths of the points must agree this well to count alone

/// The rows of a grid: cells [first[r], first[r+1]) have iy = iy0 + r.
struct Rows {
  std::int32_t iy0 = 0;
  std::vector<std::size_t> first;
  explicit Rows(const OccupancyGrid& grid) {
    if (grid.size() == 0) return;
    iy0 = grid.iy.front();
    first.assign(static_cast<std::size_t>(grid.iy.back() - iy0) + 2, grid.size());
    for (std::size_t i = grid.size(); i-- > 0;) first[static_cast<std::size_t>(grid.iy[i] - iy0)] = i;
    for (std::size_t r = first.size() - 1; r-- > 0;) first[r] = std::min(first[r], first[r + 1]);
  }
  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
};

/// Weighted second moments of centroids about one of them.
struct Moments {
  double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  int cells = 0;
  void add(double weight, double dx, double dy) {
    w += weight;
    x += weight * dx;
    y += weight * dy;
    xx += weight * dx * dx;
    xy += weight * dx * dy;
    yy += weight * dy * dy;
    ++cells;
  }
};

/// The piece of wall at a cell: direction of its normal, a negative number for clutter, and how far it passes
/// from the cell along that normal [m].
struct LocalWall {
  double theta = -1, offset_m = 0;
};

/// The line fitted to a linear neighbourhood.
LocalWall linear_wall(const Moments& m, double linearity) {
  if (m.cells < 3) return {};
  const double cxx = m.xx / m.w - m.x * m.x / (m.w * m.w);
  const double cyy = m.yy / m.w - m.y * m.y / (m.w * m.w);
  const double cxy = m.xy / m.w - m.x * m.y / (m.w * m.w);
  const double half = 0.5 * (cxx + cyy);
  const double root = std::hypot(0.5 * (cxx - cyy), cxy);
  const double largest = half + root;
  if (largest <= 0 || (half - root) >= linearity * largest) return {};
  const double along = 0.5 * std::atan2(2 * cxy, cxx - cyy);
  const double theta = normalised(along + std::numbers::pi / 2, 0).theta;
  return {theta, Line2{theta, 0}.normal().dot(Vec2(m.x, m.y) / m.w)};
}

class Classifier {
 public:
  Classifier(const OccupancyGrid& grid, const Rows& rows, double tau_m, double linearity, bool wider)
      : grid_(grid), rows_(rows), tau_(tau_m), linearity_(linearity), wider_(wider) {}

  /// The wall at cell i of row r.
  LocalWall wall(std::size_t i, std::size_t r) const {
    for (const int radius : kRadii) {
      const LocalWall wall = linear_wall(around(i, r, radius), linearity_);
      if (wall.theta >= 0 || !wider_) return wall;
    }
    if (grid_.azimuth_trust[i] < kTrust * 255) return {};
    return {azimuth_of(grid_.azimuth[i]), 0};
  }

 private:
  Moments around(std::size_t i, std::size_t r, int radius) const {
    Moments moments;
    const double reach2 = radius * tau_ * radius * tau_;
    const std::size_t first_row = r - std::min(r, static_cast<std::size_t>(radius));
    const std::size_t last_row = std::min(rows_.size() - 1, r + static_cast<std::size_t>(radius));
    for (std::size_t row = first_row; row <= last_row; ++row) {
      const auto begin = grid_.ix.begin() + static_cast<std::ptrdiff_t>(rows_.first[row]);
      const auto end = grid_.ix.begin() + static_cast<std::ptrdiff_t>(rows_.first[row + 1]);
      const auto from = std::lower_bound(begin, end, grid_.ix[i] - radius);
      for (auto it = from; it != end && *it <= grid_.ix[i] + radius; ++it) {
        const auto j = static_cast<std::size_t>(it - grid_.ix.begin());
        const double dx = grid_.x[j] - grid_.x[i];
        const double dy = grid_.y[j] - grid_.y[i];
        if (dx * dx + dy * dy <= reach2) moments.add(grid_.weight_m[j], dx, dy);
      }
    }
    return moments;
  }

  const OccupancyGrid& grid_;
  const Rows& rows_;
  double tau_;
  double linearity_;
  bool wider_;
};

void append(const OccupancyGrid& grid, int slice, WallCells& cells) {
  cells.x.insert(cells.x.end(), grid.x.begin(), grid.x.end());
  cells.y.insert(cells.y.end(), grid.y.begin(), grid.y.end());
  cells.weight_m.insert(cells.weight_m.end(), grid.weight_m.begin(), grid.weight_m.end());
  cells.area_m2.insert(cells.area_m2.end(), grid.area_m2.begin(), grid.area_m2.end());
  cells.coverage.insert(cells.coverage.end(), grid.coverage.begin(), grid.coverage.end());
  cells.slice.insert(cells.slice.end(), grid.size(), slice);
  cells.theta.resize(cells.x.size(), 0.0F);
  cells.offset_m.resize(cells.x.size(), 0.0F);
  cells.boundary.resize(cells.x.size(), 0);
  cells.line.resize(cells.x.size(), -1);
}

}  // namespace

WallCells classify_cells(const Slices& slices, double linearity, bool wider) {
  WallCells cells;
  for (std::size_t k = 0; k < slices.wall_slices.size(); ++k) {
    const OccupancyGrid& grid = slices.wall_slices[k];
    const std::size_t offset = cells.size();
    append(grid, static_cast<int>(k), cells);
    const Rows rows(grid);
    const Classifier classifier(grid, rows, slices.tau_m, linearity, wider);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows.size(), 8), [&](const auto& range) {
      for (std::size_t r = range.begin(); r != range.end(); ++r) {
        for (std::size_t i = rows.first[r]; i < rows.first[r + 1]; ++i) {
          const LocalWall wall = classifier.wall(i, r);
          cells.boundary[offset + i] = wall.theta >= 0 ? 1 : 0;
          cells.theta[offset + i] = static_cast<float>(std::max(0.0, wall.theta));
          cells.offset_m[offset + i] = static_cast<float>(wall.offset_m);
        }
      }
    });
  }
  return cells;
}

}  // namespace roomcut::detect_lines

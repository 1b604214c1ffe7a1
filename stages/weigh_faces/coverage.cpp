// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/coverage.h"

#include <algorithm>
#include <cmath>

namespace roomcut {
namespace {

constexpr double kLargestWeight = 25;
constexpr double kEnoughPoints = 10;
constexpr int kLargestRadius = 5;

}  // namespace

double AreaTable::bins(int x0, int x1, int y0, int y1) const {
  x0 = std::clamp(x0, 0, nx_);
  x1 = std::clamp(x1, x0, nx_);
  y0 = std::clamp(y0, 0, ny_);
  y1 = std::clamp(y1, y0, ny_);
  return sums_[at(x1, y1)] - sums_[at(x0, y1)] - sums_[at(x1, y0)] + sums_[at(x0, y0)];
}

double occupancy_weight(double density, double area) {
  const double probability = -std::expm1(-density * area);
  return probability * kLargestWeight > 1 ? 1 / probability : kLargestWeight;
}

double window_density(const AreaTable& counts, const AreaTable& areas, int x, int y) {
  double density = 0;
  for (int r = 1; r <= kLargestRadius; ++r) {
    const double points = counts.bins(x - r, x + r + 1, y - r, y + r + 1);
    const double area = areas.bins(x - r, x + r + 1, y - r, y + r + 1);
    density = area > 0 ? points / area : 0;
    if (points >= kEnoughPoints) {
      break;
    }
  }
  return density;
}

std::vector<float> local_density(const std::vector<float>& points, const std::vector<float>& areas, int nx,
                                 int ny) {
  const AreaTable point_table(points, nx, ny);
  std::vector<float> density(points.size(), 0.0F);
  std::vector<float> covered(points.size(), 0.0F);
  const auto measure = [&](const AreaTable& area_table) {
    std::size_t i = 0;
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x, ++i) {
        if (points[i] > 0) {
          density[i] = static_cast<float>(window_density(point_table, area_table, x, y));
          covered[i] = static_cast<float>(areas[i] * occupancy_weight(density[i], areas[i]));
        }
      }
    }
  };
  const AreaTable area_table(areas, nx, ny);
  measure(area_table);
  // Covered area of a window, at most the window.
  std::vector<float> share(points.size(), 0.0F);
  const AreaTable covered_table(covered, nx, ny);
  std::size_t i = 0;
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x, ++i) {
      const double all = area_table.bins(x - 1, x + 2, y - 1, y + 2);
      share[i] = all > 0 ? static_cast<float>(
                               areas[i] * std::min(1.0, covered_table.bins(x - 1, x + 2, y - 1, y + 2) / all))
                         : 0;
    }
  }
  measure(AreaTable(share, nx, ny));
  return density;
}

}  // namespace roomcut

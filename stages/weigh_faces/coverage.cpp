// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/coverage.h"

#include <algorithm>
#include <cmath>

namespace roomcut::weigh_faces {
namespace {

constexpr double kLargestWeight = 25;
constexpr double kEnoughPoints = 10;
constexpr int kLargestRadius = 5;

}  // namespace

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

std::vector<float> local_density(const std::vector<float>& points, const std::vector<float>& areas,
                                 const AreaTable& area_table, int nx, int ny) {
  const AreaTable point_table(points, nx, ny);
  std::vector<float> density(points.size(), 0.0F);
  const auto measure = [&](const AreaTable& surface) {
    std::size_t i = 0;
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x, ++i) {
        if (points[i] > 0) {
          density[i] = static_cast<float>(window_density(point_table, surface, x, y));
        }
      }
    }
  };
  measure(area_table);
  // Covered area of a window, at most the window.
  std::vector<float> covered(points.size(), 0.0F);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] > 0) {
      covered[i] = static_cast<float>(areas[i] * occupancy_weight(density[i], areas[i]));
    }
  }
  std::vector<float> share(points.size(), 0.0F);
  const AreaTable covered_table(covered, nx, ny);
  std::size_t i = 0;
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x, ++i) {
      const double seen = covered_table.bins(x - 1, x + 2, y - 1, y + 2);
      if (seen == 0) {
        continue;
      }
      const double all = area_table.bins(x - 1, x + 2, y - 1, y + 2);
      share[i] = all > 0 ? static_cast<float>(areas[i] * std::min(1.0, seen / all)) : 0;
    }
  }
  measure(AreaTable(share, nx, ny));
  return density;
}

}  // namespace roomcut::weigh_faces

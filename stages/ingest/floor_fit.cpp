// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/floor_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace roomcut::ingest {

namespace {

constexpr double kEdge_m = 0.8;
constexpr double kLayer_m = 0.4;  // a floor at 5 degrees rises 7 cm in a square
constexpr double kLengthSteps = 1 << 14;
constexpr double kAreaSteps = 1 << 30;
constexpr std::int64_t kFewestPoints = 20;
constexpr double kSmallest_m2 = 0.2;       // of a square
constexpr double kFewest_m2 = 4;           // of all squares
constexpr double kFollows_m = 0.01;        // from one square to the next
constexpr double kSmallestScale_m = 3e-4;  // of the Cauchy weight
constexpr double kScaleOfMedian = 2;
constexpr int kRounds = 10;
constexpr double kCondition = 0.02;  // a strip says nothing across it
constexpr double kFarthest = 0.1 * std::numbers::pi / 180;

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

/// Of the Cauchy weight: a good floor's squares lie within it, those with a skirting or a carpet do not.
double scale_of(std::vector<double> residual) {
  if (residual.empty()) {
    return kSmallestScale_m;
  }
  for (double& value : residual) {
    value = std::abs(value);
  }
  const auto middle = residual.begin() + static_cast<std::ptrdiff_t>(residual.size() / 2);
  std::nth_element(residual.begin(), middle, residual.end());
  return std::max(kSmallestScale_m, kScaleOfMedian * *middle);
}

}  // namespace

/// The points of one surface over one square.
struct FloorFit::Square {
  std::int32_t iy = 0, ix = 0, iz = 0;  ///< the last layer
  double points = 0, area_m2 = 0;
  Vec3 mean{0, 0, 0};
  std::size_t surface = 0;
};

void FloorFit::add(const CloudTile& part) {
  Sums* sums = nullptr;
  Place last{};
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (static_cast<SurfaceClass>(part.surface[i]) != SurfaceClass::kHorizontal) {
      continue;
    }
    const Place place{static_cast<std::int32_t>(std::floor(part.y[i] / kEdge_m)),
                      static_cast<std::int32_t>(std::floor(part.x[i] / kEdge_m)),
                      static_cast<std::int32_t>(std::floor(part.z[i] / kLayer_m))};
    if (sums == nullptr || place != last) {
      sums = &cells_[place];
      last = place;
    }
    ++sums->points;
    sums->x += std::llrint((part.x[i] - place.ix * kEdge_m) * kLengthSteps);
    sums->y += std::llrint((part.y[i] - place.iy * kEdge_m) * kLengthSteps);
    sums->z += std::llrint((part.z[i] - place.iz * kLayer_m) * kLengthSteps);
    sums->area += std::llrint(static_cast<double>(part.area[i]) * kAreaSteps);
  }
}

/// Cells with their means, by (iy, ix, iz); two layers that a surface passes through are one.
std::vector<FloorFit::Square> FloorFit::squares() const {
  std::vector<Square> found;
  for (const auto& [place, sums] : cells_) {
    const auto n = static_cast<double>(sums.points);
    const Vec3 corner(place.ix * kEdge_m, place.iy * kEdge_m, place.iz * kLayer_m);
    const Vec3 mean =
        corner + Vec3(static_cast<double>(sums.x), static_cast<double>(sums.y), static_cast<double>(sums.z)) /
                     (n * kLengthSteps);
    const double area = static_cast<double>(sums.area) / kAreaSteps;
    const bool same = !found.empty() && found.back().iy == place.iy && found.back().ix == place.ix &&
                      found.back().iz + 1 == place.iz && mean.z() - found.back().mean.z() < 0.5 * kLayer_m;
    if (same) {
      Square& square = found.back();
      square.mean += (mean - square.mean) * (n / (square.points + n));
      square.points += n;
      square.area_m2 += area;
      square.iz = place.iz;
    } else {
      found.push_back({place.iy, place.ix, place.iz, n, area, mean, 0});
    }
  }
  std::erase_if(found, [](const Square& square) {
    return square.points < static_cast<double>(kFewestPoints) || square.area_m2 < kSmallest_m2;
  });
  return found;
}

/// Numbers the surfaces: squares side by side are one where the height follows `slope`.
void FloorFit::join(std::vector<Square>& all, const Slope& slope) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::size_t, std::size_t>> columns;
  for (std::size_t i = 0; i < all.size(); ++i) {
    columns.try_emplace({all[i].iy, all[i].ix}, i, i).first->second.second = i + 1;
  }
  const auto height = [&](std::size_t i) { return all[i].mean.dot(Vec3(slope[0], slope[1], 1)); };
  std::vector<std::size_t> parent(all.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const auto& [dy, dx] : {std::pair{0, 1}, std::pair{1, 0}}) {
      const auto beside = columns.find({all[i].iy + dy, all[i].ix + dx});
      if (beside == columns.end()) {
        continue;
      }
      for (std::size_t k = beside->second.first; k < beside->second.second; ++k) {
        if (std::abs(height(k) - height(i)) < kFollows_m) {
          parent[root_of(parent, k)] = root_of(parent, i);
        }
      }
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].surface = root_of(parent, i);
  }
}

/// One round of least squares with the weights that the residuals ask for, which are renewed. Returns false
/// when the squares say too little.
bool FloorFit::solve(const std::vector<Square>& all, std::vector<double>& residual, Slope& slope) {
  const double scale = scale_of(residual);
  std::vector<double> weight(all.size());
  std::vector<double> total(all.size(), 0);  // of a surface
  std::vector<Vec3> middle(all.size(), Vec3(0, 0, 0));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double u = residual[i] / scale;
    weight[i] = all[i].area_m2 / (1 + u * u);
    total[all[i].surface] += weight[i];
    middle[all[i].surface] += weight[i] * all[i].mean;
  }
  const auto centred = [&](std::size_t i) -> Vec3 {
    return all[i].mean - middle[all[i].surface] / total[all[i].surface];
  };
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  double area = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vec3 p = centred(i);
    moments += weight[i] * p * p.transpose();
    area += p.head<2>().norm() > 0 ? weight[i] : 0;
  }
  const Eigen::Matrix2d level = moments.topLeftCorner<2, 2>();
  const double spread = level.trace();
  if (area < kFewest_m2 || level.determinant() < kCondition * spread * spread) {
    return false;
  }
  const Vec2 found = -level.inverse() * moments.topRightCorner<2, 1>();  // up leans where the floor falls
  slope = {found.x(), found.y()};
  for (std::size_t i = 0; i < all.size(); ++i) {
    residual[i] = centred(i).dot(Vec3(found.x(), found.y(), 1));
  }
  return true;
}

FloorFit::Slope FloorFit::slope(const Slope& slope) const {
  std::vector<Square> all = squares();
  join(all, slope);
  std::vector<double> residual(all.size(), 0);
  Slope found = slope;
  for (int round = 0; round < kRounds; ++round) {
    if (!solve(all, residual, found)) {
      return slope;
    }
  }
  return std::hypot(found[0] - slope[0], found[1] - slope[1]) < kFarthest ? found : slope;
}

}  // namespace roomcut::ingest

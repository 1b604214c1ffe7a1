// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/roughness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace roomcut::fit_surfaces {
namespace {

constexpr int kLags = 8;            // distances up to that many patches
constexpr double kFewestCells = 8;  // of a region that speaks
constexpr double kBound = 3;        // standard deviations at which a residual is another surface
constexpr double kExplained = 0.75;
constexpr double kLarge = 6;        // independent patches of a region that may speak by its tilted plane
constexpr double kVanished = 0.05;  // share of the variance
constexpr int kRounds = 5;

/// Sums of products of residuals by distance, in patches, rounded.
struct Covariances {
  std::array<double, kLags + 1> product{}, count{};
  double square = 0;  ///< of residuals, their own variances included

  double at(int lag) const {
    const auto k = static_cast<std::size_t>(lag);
    return count[k] > 0 ? product[k] / count[k] : 0;
  }
};

struct Cell {
  double share = 0, residual = 0, variance = 0;  // sums, weighted by share
};

/// From a cell to another one, each pair once.
struct Step {
  long dx, dy;
  std::size_t lag;
};

const std::vector<Step>& steps() {
  static const std::vector<Step> all = [] {
    std::vector<Step> result;
    for (long dy = 0; dy <= kLags; ++dy) {
      for (long dx = dy == 0 ? 1 : -kLags; dx <= kLags; ++dx) {
        const auto lag = static_cast<std::size_t>(std::lround(std::hypot(dx, dy)));
        if (lag <= kLags) {
          result.push_back({dx, dy, lag});
        }
      }
    }
    return result;
  }();
  return all;
}

/// Residuals about `fit` of the region's patches, those of one grid cell as one.
Covariances covariances_of(const RoughRegion& region, const PlaneFit& fit, double patch_m) {
  std::map<std::pair<long, long>, Cell> cells;
  for (const Sample& s : region.samples) {
    const double bound = kBound * std::sqrt(s.variance_m2 + fit.unevenness_m * fit.unevenness_m);
    const double r = s.z - fit.height(s.at);
    if (std::abs(r) <= bound) {
      Cell& cell =
          cells[{std::lround(std::floor(s.at.y() / patch_m)), std::lround(std::floor(s.at.x() / patch_m))}];
      cell.share += s.share;
      cell.residual += s.share * r;
      cell.variance += s.share * s.share * s.variance_m2;
    }
  }
  Covariances sums;
  if (static_cast<double>(cells.size()) < kFewestCells) {
    return sums;
  }
  for (const auto& [place, cell] : cells) {
    const double r = cell.residual / cell.share;
    sums.product[0] += r * r - cell.variance / (cell.share * cell.share);
    sums.count[0] += 1;
    sums.square += r * r;
    for (const Step& step : steps()) {
      const auto other = cells.find({place.first + step.dy, place.second + step.dx});
      if (other != cells.end()) {
        sums.product[step.lag] += r * other->second.residual / other->second.share;
        sums.count[step.lag] += 1;
      }
    }
  }
  return sums;
}

/// Patches that err as one: the covariances' sum over the plan, up to where they vanish in their standard
/// error, over the variance. `hidden` is added to all.
double correlated_patches(const Covariances& sums, double hidden) {
  const double variance = sums.at(0) + hidden;
  double patches = 1;
  for (int lag = 1; lag <= kLags && variance > 0; ++lag) {
    const double count = sums.count[static_cast<std::size_t>(lag)];
    if (count < kFewestCells || sums.at(lag) < 2 * sums.square / sums.count[0] / std::sqrt(count) ||
        sums.at(lag) < kVanished * sums.at(0)) {
      break;
    }
    patches += 2 * std::numbers::pi * lag * std::min(1.0, (sums.at(lag) + hidden) / variance);
  }
  return patches;
}

}  // namespace

Roughness measure_roughness(const std::vector<RoughRegion>& regions, double patch_m) {
  std::vector<Covariances> level;
  std::vector<Covariances> tilted;
  for (const RoughRegion& region : regions) {
    level.push_back(covariances_of(region, region.fits->level, patch_m));
    tilted.push_back(covariances_of(region, region.fits->tilted, patch_m));
  }
  Roughness result;
  double hidden = 0;
  for (int round = 0; round < kRounds; ++round) {
    Covariances sums;
    std::vector<std::pair<double, double>> variances;
    double alike = 0;
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const double cells = level[i].count[0];
      if (cells == 0) {
        continue;
      }
      const bool tilts =
          tilted[i].count[0] > kLarge * result.patches && tilted[i].at(0) < (1 - kExplained) * level[i].at(0);
      const Covariances& own = tilts ? tilted[i] : level[i];
      for (std::size_t k = 0; k < own.product.size(); ++k) {
        sums.product[k] += own.product[k];
        sums.count[k] += own.count[k];
      }
      sums.square += own.square;
      variances.emplace_back(own.at(0), own.count[0]);
      alike += std::min(own.count[0], result.patches);
    }
    if (variances.empty()) {
      return result;
    }
    // What a region's mean has taken with it, on average: its variance.
    const double hidden_share = std::min(0.7, alike / sums.count[0]);
    hidden = std::max(0.0, sums.at(0)) * hidden_share / (1 - hidden_share);
    result.patches = correlated_patches(sums, hidden);
    std::sort(variances.begin(), variances.end());
    double half = 0.5 * sums.count[0];
    auto median = variances.begin();
    while (median + 1 != variances.end() && (half -= median->second) > 0) {
      ++median;
    }
    result.variance_m2 = std::max(0.0, median->first) / (1 - hidden_share);
  }
  return result;
}

}  // namespace roomcut::fit_surfaces

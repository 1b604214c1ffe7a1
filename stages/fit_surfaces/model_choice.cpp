// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/model_choice.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "stages/fit_surfaces/two_heights.h"

namespace roomcut::fit_surfaces {
namespace {

constexpr double kFinest_m = 0.0005;    // no floor is more even than this
constexpr double kFewestPatches = 6;    // to prove a tilt
constexpr double kLeastFall_m = 0.002;  // over the samples
constexpr double kSteepest = 0.1;       // steeper floors are sloped planes, which slice finds
constexpr double kChance = 13.8;        // chi square of two degrees of freedom: one in a thousand
constexpr double kOutside_m = 1;        // a tilt may go on this far, and as far again as it was seen

double cost_of(std::span<const Sample> samples, double scale, const PlaneFit& fit) {
  return truncated_cost(samples, scale, [&](const Sample& s) { return s.z - fit.height(s.at); });
}

/// What a parameter must save.
double price(std::span<const Sample> samples) {
  return 2 * std::log(std::max(2.0, patches(samples)));
}

template <class Place>
std::pair<double, double> range_along(const Vec2& direction, std::span<const Place> places) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Place& place : places) {
    double t = 0;
    if constexpr (std::is_same_v<Place, Sample>) {
      t = direction.dot(place.at);
    } else {
      t = direction.dot(place);
    }
    low = std::min(low, t);
    high = std::max(high, t);
  }
  return {low, high};
}

/// Whether the tilt is more than chance and more than nothing, and seen over most of the region.
bool is_proven(std::span<const Sample> samples, std::span<const Vec2> outline, const PlaneFit& tilted) {
  const double steep = tilted.gradient.norm();
  if (patches(samples) < kFewestPatches || !(steep > 0) || steep > kSteepest) {
    return false;
  }
  const Eigen::Matrix2d covariance = tilted.covariance.bottomRightCorner<2, 2>();
  const double wald = tilted.gradient.dot(covariance.inverse() * tilted.gradient);
  const Vec2 uphill = tilted.gradient / steep;
  const auto [low, high] = range_along(uphill, samples);
  const auto [from, to] = range_along(uphill, outline);
  return wald > std::max(kChance, 6 + price(samples)) && steep * (high - low) > kLeastFall_m &&
         to - from < 2 * (high - low) + kOutside_m;
}

/// The samples nearer to the height that more of them have.
std::vector<Sample> larger_part(std::span<const Sample> samples, const TwoHeights& two) {
  std::vector<Sample> parts[2];
  for (std::size_t i = 0; i < samples.size(); ++i) {
    parts[two.is_high[i] ? 1 : 0].push_back(samples[i]);
  }
  return patches(parts[1]) > patches(parts[0]) ? std::move(parts[1]) : std::move(parts[0]);
}

struct Costs {
  double level = 0, tilted = 0, two = std::numeric_limits<double>::infinity();
};

Costs costs_of(std::span<const Sample> samples, const Fits& fits, const TwoHeights* two) {
  double scale = std::max(kFinest_m, std::min(fits.level.unevenness_m, fits.tilted.unevenness_m));
  scale = two != nullptr ? std::max(kFinest_m, std::min(scale, two->unevenness_m)) : scale;
  Costs costs{cost_of(samples, scale, fits.level), cost_of(samples, scale, fits.tilted) + 2 * price(samples)};
  if (two != nullptr) {
    costs.two =
        3 * price(samples) + truncated_cost(samples, scale, [&](const Sample& s) { return two->off(s); });
  }
  return costs;
}

}  // namespace

Fits fit_both(std::span<const Sample> samples, const Vec2& middle) {
  return {fit_level(samples, middle), fit_tilted(samples, middle, Vec2(0, 0))};
}

PlaneFit choose_surface(std::span<const Sample> samples, Fits fits, std::span<const Vec2> outline,
                        const Roughness& roughness, bool may_tilt) {
  const std::optional<TwoHeights> two = find_two_heights(samples);
  const Costs costs = costs_of(samples, fits, two ? &*two : nullptr);
  if (may_tilt && costs.tilted < std::min(costs.level, costs.two)) {
    measure_covariance(samples, roughness, fits.tilted);
    if (is_proven(samples, outline, fits.tilted)) {
      return fits.tilted;
    }
  }
  if (costs.two < std::min(costs.level, may_tilt ? costs.tilted : costs.level)) {
    const std::vector<Sample> part = larger_part(samples, *two);
    PlaneFit fit = fit_level(part, fits.level.middle);
    measure_covariance(part, roughness, fit);
    return fit;
  }
  measure_covariance(samples, roughness, fits.level);
  return fits.level;
}

bool has_two_heights(std::span<const Sample> samples, const Fits& fits, const TwoHeights& two) {
  const Costs costs = costs_of(samples, fits, &two);
  return costs.two < std::min(costs.level, costs.tilted);
}

}  // namespace roomcut::fit_surfaces

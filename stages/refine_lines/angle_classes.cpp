// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/angle_classes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace roomcut::refine_lines {

namespace {

constexpr double kWidest_rad = 1.5 * std::numbers::pi / 180.0;
constexpr double kSignificant = 3.0;                             ///< standard deviations
constexpr double kVaguest_rad = 1.0 * std::numbers::pi / 180.0;  ///< a direction less certain begins no class
constexpr double kSurest_rad = 1e-6;  ///< keeps weights finite on data without noise

double weight(const Direction& direction) {
  const double sigma = std::max(direction.sigma, kSurest_rad);
  return 1 / (sigma * sigma);
}

struct Class {
  double angle;
  double weights;
  std::vector<std::size_t> members;
};

/// Grows a class from its most precise member, taking the others in order of their precision.
Class grow(const std::vector<Direction>& directions, const std::vector<std::size_t>& order, std::size_t begin,
           const std::vector<int>& taken) {
  const Direction& seed = directions[order[begin]];
  Class result{seed.theta, weight(seed), {order[begin]}};
  for (std::size_t k = begin + 1; k < order.size(); ++k) {
    const Direction& candidate = directions[order[k]];
    if (taken[order[k]] >= 0) {
      continue;
    }
    const double off = off_class(candidate.theta, result.angle);
    const double sigma = std::sqrt(1 / weight(candidate) + 1 / result.weights);
    if (std::abs(off) <= std::min(kWidest_rad, kSignificant * sigma)) {
      const double w = weight(candidate);
      result.angle += off * w / (result.weights + w);
      result.weights += w;
      result.members.push_back(order[k]);
    }
  }
  return result;
}

}  // namespace

double off_class(double theta, double angle) {
  return std::remainder(theta - angle, std::numbers::pi / 2);
}

AngleClasses find_angle_classes(const std::vector<Direction>& directions) {
  AngleClasses classes;
  classes.class_of.assign(directions.size(), -1);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (directions[i].takes_part) {
      order.push_back(i);
    }
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(directions[a].sigma, directions[a].id) <
           std::pair(directions[b].sigma, directions[b].id);
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (classes.class_of[order[k]] >= 0 || directions[order[k]].sigma > kVaguest_rad) {
      continue;
    }
    const Class found = grow(directions, order, k, classes.class_of);
    if (found.members.size() > 1) {
      for (const std::size_t member : found.members) {
        classes.class_of[member] = static_cast<int>(classes.angle.size());
      }
      classes.angle.push_back(off_class(found.angle, 0));
    }
  }
  return classes;
}

}  // namespace roomcut::refine_lines

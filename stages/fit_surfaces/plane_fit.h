// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut::fit_surfaces {

/// The height of a surface in one patch.
struct Sample {
  Vec2 at{0, 0};
  double z = 0;
  double variance_m2 = 0;  ///< of z, as its points let expect
  double share = 1;        ///< of a whole patch that it is, 0 … 1: how much it counts
};

/// How patches of floor err beyond their own variances, and how far they err alike.
struct Roughness {
  double variance_m2 = 0;
  double patches = 1;  ///< that err as one
};

/// A plane fitted to samples: height z + gradient · (p - middle).
struct PlaneFit {
  Vec2 middle{0, 0};
  double z = 0;
  Vec2 gradient{0, 0};
  bool tilts = false;                                    ///< its gradient was fitted, too
  Vec2 expected{0, 0};                                   ///< gradient where the samples don't tell
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of z and gradient, once measured
  double unevenness_m = 0;  ///< what the samples scatter about it beyond their variances
  double rms_m = 0;         ///< of the samples on it

  double height(const Vec2& p) const { return z + gradient.dot(p - middle); }
};

/// Level surface through the samples (at least one): Tukey's biweight from several starts, so that of two
/// heights it lies on the one with more area, never between. `middle` is where its height is asked for.
PlaneFit fit_level(std::span<const Sample> samples, const Vec2& middle);

/// Tilted plane through the samples, likewise; `expected` is what its gradient is where the samples don't
/// tell, to within 0.02.
PlaneFit fit_tilted(std::span<const Sample> samples, const Vec2& middle, const Vec2& expected);

/// Fills in the covariance of a fit to these samples: as the building's roughness lets expect, or from the
/// samples' own scatter in blocks of ½, 1, 2 and 4 m, where that is more: neighbouring residuals resemble
/// each other, those of large blocks don't.
void measure_covariance(std::span<const Sample> samples, const Roughness& roughness, PlaneFit& fit);

/// Sum over the samples of their squared distance from what `off` gives for each, in standard deviations
/// with `unevenness_m`, truncated: what costs more is another surface.
template <class Off>
double truncated_cost(std::span<const Sample> samples, double unevenness_m, Off&& off) {
  constexpr double kBound2 = 9;
  double sum = 0;
  for (const Sample& s : samples) {
    const double r = off(s);
    const double q = r * r / (s.variance_m2 + unevenness_m * unevenness_m);
    sum += s.share * (q < kBound2 ? q : kBound2);
  }
  return sum;
}

/// What residuals scatter beyond the samples' variances [m]: robust, at most 3 cm. `residuals` as samples.
double unevenness(std::span<const Sample> samples, const std::vector<double>& residuals);

/// Sum of the samples' shares: patches of floor.
double patches(std::span<const Sample> samples);

}  // namespace roomcut::fit_surfaces

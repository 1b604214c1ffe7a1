// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "stages/fit_surfaces/plane_fit.h"
#include "stages/fit_surfaces/two_heights.h"

namespace roomcut::fit_surfaces {

/// The two surfaces that a region may have.
struct Fits {
  PlaneFit level, tilted;
};
Fits fit_both(std::span<const Sample> samples, const Vec2& middle);

/// Level, or tilted where the samples prove it: the tilt explains more than level ones at one or two heights
/// do (Bayesian information criterion), is more than chance by the fit's covariance, and the samples reach
/// over most of what it is to hold for. Where the samples lie at two heights, the surface is level at that
/// with more area. `fits` are those to the samples, `outline` the corners of the region. At least one sample.
PlaneFit choose_surface(std::span<const Sample> samples, Fits fits, std::span<const Vec2> outline,
                        const Roughness& roughness, bool may_tilt);

/// Whether two level surfaces explain the samples better than one, level or tilted.
bool has_two_heights(std::span<const Sample> samples, const Fits& fits, const TwoHeights& two);

}  // namespace roomcut::fit_surfaces

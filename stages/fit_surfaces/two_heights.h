// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "stages/fit_surfaces/plane_fit.h"

namespace roomcut::fit_surfaces {

/// Samples that lie at two heights.
struct TwoHeights {
  double low = 0, high = 0;   ///< [m]
  double unevenness_m = 0;    ///< about them
  std::vector<bool> is_high;  ///< per sample: nearer to `high`

  double off(const Sample& s) const {
    const double below = s.z - low;
    const double above = s.z - high;
    return below * below < above * above ? below : above;
  }
};

/// The two fullest heights of the samples, when they are clearly apart (4 mm and 4 standard deviations) and
/// hold two patches each; a slope has none.
std::optional<TwoHeights> find_two_heights(std::span<const Sample> samples);

}  // namespace roomcut::fit_surfaces

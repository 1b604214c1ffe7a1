// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "stages/fit_surfaces/model_choice.h"

namespace roomcut::fit_surfaces {

/// A floor or ceiling whose patches say how rough floors are here.
struct RoughRegion {
  std::span<const Sample> samples;
  const Fits* fits = nullptr;  ///< to them
};

/// How patches err together beyond their own variances, measured over all regions of a building: a warped
/// scan moves whole rooms, whose own patches, seen from their mean, don't tell. The covariance of residuals
/// by distance, its variance the regions' median by area, plus what taking off each region's mean has hidden.
/// A region much larger than the reach of the correlation, of whose variance a tilt explains three quarters,
/// speaks by its residuals from the tilted plane. `patch_m`: edge of a patch.
Roughness measure_roughness(const std::vector<RoughRegion>& regions, double patch_m);

}  // namespace roomcut::fit_surfaces

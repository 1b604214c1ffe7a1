// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "stages/slice/regions.h"
#include "stages/slice/survey.h"

namespace roomcut::slice {

enum class PlaneSide : std::uint8_t { kCeiling, kFloor, kClutter };

/// Whether a sloped surface is seen from below, as a roof or a stair's underside is, or from above, as a ramp
/// is. What lies over and under it says so: a slab's other side is less than 0.6 m away, and where nothing
/// lies, nobody stood. Where that leaves it open, walls hang from a ceiling and stand on a floor; what hovers
/// between a floor and a ceiling, without walls and touching no other region, is clutter. `region_of` says
/// for each voxel which region it belongs to, or -1.
PlaneSide side_of(const PlanarRegion& region, const HeightSurvey& survey,
                  const std::vector<std::int32_t>& region_of);

}  // namespace roomcut::slice

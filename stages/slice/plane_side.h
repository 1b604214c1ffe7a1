// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "stages/slice/regions.h"
#include "stages/slice/survey.h"

namespace roomcut::slice {

enum class PlaneSide : std::uint8_t { kCeiling, kFloor, kClutter };

/// Whether a sloped surface is seen from below, as a roof or a stair's underside is, or from above, as a ramp
/// is. What lies over and under it says so: a slab's other side is less than 0.6 m away, and where nothing
/// lies, nobody stood. Where that leaves it open, walls hang from a ceiling and stand on a floor; what hovers
/// between a floor and a ceiling without walls is clutter.
PlaneSide side_of(const PlanarRegion& region, const HeightSurvey& survey);

}  // namespace roomcut::slice

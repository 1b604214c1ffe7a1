// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/artefact/json.h"
#include "common/sloped_planes/accepted_planes.h"

namespace roomcut {

/// Names of the properties that the format defines; all others are the user's.
inline constexpr const char* kPlaneProperties[] = {"plane_id", "pitch_deg", "uphill_deg", "height_m", "side",
                                                   "source",   "locked",    "area_m2",    "rms_m",    "note"};
inline constexpr const char* kCeilingSide = "ceiling";
inline constexpr const char* kFloorSide = "floor";

/// Steeper ones are walls [deg]; cells.h5 holds no others.
inline constexpr double kSteepestPlane_deg = 87;

/// Outlines of less area have none worth the name [m^2, in plan].
inline constexpr double kSmallestOutline_m2 = 1e-2;

/// Whether the format defines the property.
bool is_plane_property(const std::string& name);

}  // namespace roomcut

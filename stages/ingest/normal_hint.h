// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/cloud/cloud.h"
#include "stages/ingest/params.h"

namespace roomcut::ingest {

/// Azimuth byte of an upright plane with this normal (either of its two directions).
inline std::uint8_t azimuth_step(double nx, double ny) {
  double theta = std::atan2(ny, nx);
  theta += theta < 0 ? std::numbers::pi : 0;
  const int step = static_cast<int>(theta * (kAzimuthSteps / std::numbers::pi));
  return static_cast<std::uint8_t>(step == kAzimuthSteps ? 0 : std::min(step, kAzimuthSteps - 1));
}

/// Class of a plane whose unit normal has this |nz|.
inline SurfaceClass class_of_slope(double abs_nz, const IngestParams& params) {
  if (abs_nz > params.level_min_nz) {
    return SurfaceClass::kHorizontal;
  }
  return abs_nz < params.wall_max_nz ? SurfaceClass::kWall : SurfaceClass::kSloped;
}

/// Class and azimuth of a point's own normal, packed as class + 256 · azimuth; 0 when it is no direction.
inline std::uint16_t normal_hint(float nx, float ny, float nz, const IngestParams& params) {
  const double length = std::sqrt(double{nx} * nx + double{ny} * ny + double{nz} * nz);
  if (!(length > 0.1 && length < 1e6)) {  // also for NaN
    return 0;
  }
  const SurfaceClass surface = class_of_slope(std::abs(nz) / length, params);
  const unsigned azimuth = surface == SurfaceClass::kWall ? azimuth_step(nx, ny) : 0;
  return static_cast<std::uint16_t>(static_cast<unsigned>(surface) + 256 * azimuth);
}

}  // namespace roomcut::ingest

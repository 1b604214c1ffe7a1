// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/sloped_plane.h"
#include "stages/slice/regions.h"
#include "stages/slice/survey.h"

namespace roomcut::slice {

/// What the voxels' surfaces are.
struct SlopedSurfaces {
  std::vector<SlopedPlane> planes;     ///< largest first
  std::vector<std::int32_t> of_voxel;  ///< per voxel of the survey an index into planes, or:
  static constexpr std::int32_t kNone = -1;
  static constexpr std::int32_t kLevel = -2;  ///< a part of a surface that does not slope
};

/// Sloped floors and ceilings: connected planar surfaces of at least 2 m^2 (region_kinds.h), and the facets
/// of what else slopes (facets.h). Clutter is none (plane_side.h). Deterministic.
SlopedSurfaces find_planes(const HeightSurvey& survey, double noise_m);

/// Takes what lies on the planes out of the survey: the patches, which would smear the levels, and the sloped
/// area of the upright blocks, which is explained.
void remove_planes(const SlopedSurfaces& surfaces, double noise_m, HeightSurvey& survey);

}  // namespace roomcut::slice

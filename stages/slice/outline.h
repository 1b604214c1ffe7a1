// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stages/slice/regions.h"

namespace roomcut::slice {

/// The convex hull in plan of a region's points, counter-clockwise: of rectangles spread as those of each
/// voxel are. Where the plane of another region is near it goes on to where both meet: there voxels hold
/// points of both, and belong to none. `region_of` says for each voxel which of `regions` it belongs to, or
/// -1.
std::vector<Vec2> outline_of(std::size_t region, const std::vector<PlanarRegion>& regions,
                             const std::vector<SurfaceVoxel>& voxels,
                             const std::vector<std::int32_t>& region_of);

}  // namespace roomcut::slice

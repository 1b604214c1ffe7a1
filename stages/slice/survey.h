// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/slices/slices.h"
#include "stages/slice/tile_source.h"
#include "stages/slice/voxels.h"

namespace roomcut::slice {

/// Horizontal points of one plan cell and height bin, as sums.
struct SurfacePatch {
  std::int32_t ix = 0, iy = 0;  ///< plan cell: floor(x / raster), floor(y / raster)
  std::int32_t count = 0;       ///< points
  double z = 0;                 ///< mean height weighted by area [m]
  double area_m2 = 0;           ///< surface area that the points stand for
};

/// Wall and sloped points of one coarse cell.
struct UprightBlock {
  std::int32_t ix = 0, iy = 0;  ///< plan cell of kUprightPlan
  std::int32_t iz = 0;          ///< height bin of kUprightHeight
  double area_m2 = 0;
  double sloped_m2 = 0;  ///< the sloped part of it
};
inline constexpr double kUprightPlan = 0.5;     // m
inline constexpr double kUprightHeight = 0.05;  // m

/// What one pass over the points tells of heights.
struct HeightSurvey {
  double raster_m = 0;
  std::vector<SurfacePatch> patches;  ///< sorted by (iy, ix, z)
  VerticalHistogram horizontal;       ///< area of horizontal points
  std::vector<UprightBlock> upright;  ///< sorted by (iy, ix, iz)
  VoxelSize voxel;
  std::vector<SurfaceVoxel> voxels;  ///< of horizontal and sloped points, sorted by (iy, ix, iz)
};

/// Sums horizontal, wall and sloped points over heights (one pass). Every point weighs the area it stands
/// for, which takes the anisotropy of the scan out of the histogram; without `by_area` horizontal points
/// weigh all the same, the scan's mean. Integer sums: the result does not depend on order or threads.
HeightSurvey survey_heights(const CloudHeader& header, const TileSource& tiles, double raster_m, double bin_m,
                            bool by_area = true);

}  // namespace roomcut::slice

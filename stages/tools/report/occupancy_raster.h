// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/geometry/scan_coordinates.h"
#include "common/picture/image.h"
#include "common/slices/slices.h"

namespace roomcut::report {

/// A picture of an occupancy grid, one pixel a cell, and the box of the plan that it fills [m].
struct GridRaster {
  Image image;
  Vec2 low, high;
};

/// The grid of wall slice `slice`, two cells wider than the scan on every side: darker where points cover
/// more of the slice's height, white where there are none.
GridRaster occupancy_raster(const Slices& slices, std::size_t slice);

/// Where a raster lies in the scan's own coordinates: pixel (column, row) at corner + column * right + row *
/// down.
struct RasterPlace {
  Vec2 corner;       ///< of the upper left pixel, its outer corner [m]
  Vec2 right, down;  ///< to the next pixel [m]
};
RasterPlace place_of(const GridRaster& raster, double cell_m, const Frame& frame);

/// The world file (.pgw) of a raster: where QGIS and other programs put it.
std::string world_file(const RasterPlace& place);

/// The .aux.xml of a raster for GDAL, hence QGIS: the same, and the coordinate system of wall_lines.geojson,
/// `crs`.
std::string aux_file(const RasterPlace& place, const std::string& crs);

}  // namespace roomcut::report

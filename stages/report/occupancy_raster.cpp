// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/report/occupancy_raster.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace roomcut {

GridRaster occupancy_raster(const Slices& slices, std::size_t slice) {
  const double tau = slices.tau_m;
  const auto index = [tau](double v) { return static_cast<std::int32_t>(std::floor(v / tau)); };
  const std::int32_t ix0 = index(slices.bbox_min.x()) - 2, iy0 = index(slices.bbox_min.y()) - 2;
  const int width = index(slices.bbox_max.x()) + 3 - ix0, height = index(slices.bbox_max.y()) + 3 - iy0;
  GridRaster raster{
      Image(width, height), {ix0 * tau, iy0 * tau}, {(ix0 + width) * tau, (iy0 + height) * tau}};
  const OccupancyGrid& grid = slices.wall_slices[slice];
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double coverage = std::clamp(static_cast<double>(grid.coverage[i]), 0.0, 1.0);
    const auto light = static_cast<std::uint8_t>(std::lround(225 - 195 * coverage));
    raster.image.set(grid.ix[i] - ix0, height - 1 - (grid.iy[i] - iy0), {light, light, light});
  }
  return raster;
}

std::string world_file(const GridRaster& raster, double cell_m) {
  char text[200];
  std::snprintf(text, sizeof text, "%.12g\n0\n0\n%.12g\n%.9f\n%.9f\n", cell_m, -cell_m,
                raster.low.x() + 0.5 * cell_m, raster.high.y() - 0.5 * cell_m);
  return text;
}

std::string aux_file(const GridRaster& raster, double cell_m, const std::string& crs) {
  char numbers[200];
  std::snprintf(numbers, sizeof numbers, "%.9f, %.12g, 0, %.9f, 0, %.12g", raster.low.x(), cell_m,
                raster.high.y(), -cell_m);
  return "<PAMDataset>\n  <SRS>" + crs + "</SRS>\n  <GeoTransform>" + numbers +
         "</GeoTransform>\n</PAMDataset>\n";
}

}  // namespace roomcut

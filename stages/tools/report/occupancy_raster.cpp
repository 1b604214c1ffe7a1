// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/occupancy_raster.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/picture/svg.h"

namespace roomcut::report {

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

RasterPlace place_of(const GridRaster& raster, double cell_m, const Frame& frame) {
  const ScanCoordinates scan(frame);
  return {scan.plan_to_scan({raster.low.x(), raster.high.y()}), scan.plan_turn() * Vec2(cell_m, 0),
          scan.plan_turn() * Vec2(0, -cell_m)};
}

std::string world_file(const RasterPlace& place) {
  const Vec2 middle = place.corner + 0.5 * (place.right + place.down);  // of the upper left pixel
  char text[300];
  std::snprintf(text, sizeof text, "%.12g\n%.12g\n%.12g\n%.12g\n%.9f\n%.9f\n", place.right.x(),
                place.right.y(), place.down.x(), place.down.y(), middle.x(), middle.y());
  return text;
}

std::string aux_file(const RasterPlace& place, const std::string& crs) {
  char numbers[300];
  std::snprintf(numbers, sizeof numbers, "%.9f, %.12g, %.12g, %.9f, %.12g, %.12g", place.corner.x(),
                place.right.x(), place.down.x(), place.corner.y(), place.right.y(), place.down.y());
  return "<PAMDataset>\n  <SRS>" + escaped(crs) + "</SRS>\n  <GeoTransform>" + numbers +
         "</GeoTransform>\n</PAMDataset>\n";
}

}  // namespace roomcut::report

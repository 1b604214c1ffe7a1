// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/occupancy_raster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace roomcut::report {
namespace {

/// Cells of 0.5 m; one cell is occupied, from (1, -0.5) to (1.5, 0), over all of the height.
Slices one_cell() {
  Slices slices;
  slices.tau_m = 0.5;
  slices.bbox_min = {-1, -2, 0};
  slices.bbox_max = {3, 1, 3};
  slices.levels.resize(2);
  slices.wall_slices.resize(1);
  OccupancyGrid& grid = slices.wall_slices[0];
  grid.ix = {2};
  grid.iy = {-1};
  grid.coverage = {1};
  return slices;
}

TEST(OccupancyRaster, the_world_file_puts_each_pixel_where_its_cell_is) {
  const Slices slices = one_cell();
  const GridRaster raster = occupancy_raster(slices, 0);
  double a = 0, d = 0, b = 0, e = 0, x = 0, y = 0;
  std::istringstream(world_file(place_of(raster, slices.tau_m, {}))) >> a >> d >> b >> e >> x >> y;
  EXPECT_EQ(d, 0);
  EXPECT_EQ(b, 0);
  int dark = 0;
  for (int row = 0; row < raster.image.height(); ++row) {
    for (int column = 0; column < raster.image.width(); ++column) {
      if (!(raster.image.get(column, row) == Colour{255, 255, 255})) {
        ++dark;
        EXPECT_DOUBLE_EQ(x + a * column, 1.25);
        EXPECT_DOUBLE_EQ(y + e * row, -0.25);
      }
    }
  }
  EXPECT_EQ(dark, 1);
}

TEST(OccupancyRaster, its_box_holds_the_scan_and_fits_the_pixels) {
  const GridRaster raster = occupancy_raster(one_cell(), 0);
  EXPECT_LT(raster.low.x(), -1);
  EXPECT_LT(raster.low.y(), -2);
  EXPECT_GT(raster.high.x(), 3);
  EXPECT_GT(raster.high.y(), 1);
  EXPECT_DOUBLE_EQ(raster.high.x() - raster.low.x(), 0.5 * raster.image.width());
  EXPECT_DOUBLE_EQ(raster.high.y() - raster.low.y(), 0.5 * raster.image.height());
}

TEST(OccupancyRaster, of_a_levelled_scan_far_away_each_pixel_lies_where_the_lines_of_the_plan_do) {
  Slices slices = one_cell();
  slices.frame.origin[0] = 691234.125;
  slices.frame.origin[1] = 5334567.25;
  slices.frame.level[0] = 0.03;
  slices.frame.level[1] = 0.04;
  slices.frame.level[2] = std::sqrt(1 - 0.0025);
  const GridRaster raster = occupancy_raster(slices, 0);
  double a = 0, d = 0, b = 0, e = 0, x = 0, y = 0;
  std::istringstream(world_file(place_of(raster, slices.tau_m, slices.frame))) >> a >> d >> b >> e >> x >> y;
  const ScanCoordinates scan(slices.frame);
  for (const auto& [column, row] : {std::pair{0, 0}, std::pair{5, 3}, std::pair{7, 1}}) {
    const Vec2 local(raster.low.x() + 0.5 * (column + 0.5), raster.high.y() - 0.5 * (row + 0.5));
    const Vec2 world(a * column + b * row + x, d * column + e * row + y);
    EXPECT_LT((world - scan.plan_to_scan(local)).norm(), 1e-6);
  }
}

TEST(OccupancyRaster, gdal_gets_the_coordinate_system_and_the_corner) {
  const Slices slices = one_cell();
  const GridRaster raster = occupancy_raster(slices, 0);
  const std::string text = aux_file(place_of(raster, slices.tau_m, {}), "LOCAL_CS[\"a\"]");
  EXPECT_NE(text.find("<SRS>LOCAL_CS[&quot;a&quot;]</SRS>"), std::string::npos);
  EXPECT_NE(text.find("<GeoTransform>-2.000000000, 0.5, 0, 2.500000000, 0, -0.5</GeoTransform>"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace roomcut::report

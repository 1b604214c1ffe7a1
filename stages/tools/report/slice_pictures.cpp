// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/picture/colour_map.h"
#include "common/picture/svg.h"
#include "stages/tools/report/occupancy_raster.h"
#include "stages/tools/report/pictures.h"

namespace roomcut::report {

namespace {

constexpr Colour kInk{40, 40, 40}, kBand{86, 180, 233}, kWallSlice{240, 228, 66}, kPeak{213, 94, 0};

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", value);
  return text;
}

}  // namespace

Picture draw_histogram(const Slices& slices) {
  const ScanCoordinates scan(slices.frame);
  const VerticalHistogram& histogram = slices.histogram;
  const double top = histogram.z0 + histogram.bin_m * static_cast<double>(histogram.area_m2.size());
  const double most = std::max(1e-9, *std::max_element(histogram.area_m2.begin(), histogram.area_m2.end()));
  const double height = top - histogram.z0;
  const double width = 0.8 * height;  // the longest bar, in metres of the drawing
  Svg svg({-0.25 * height, histogram.z0 - 0.03 * height}, {1.1 * height, top + 0.03 * height}, 620 / height);
  for (std::size_t k = 0; k + 1 < slices.levels.size(); ++k) {
    svg.rectangle({0, slices.levels[k].hi}, {width, slices.levels[k + 1].lo}, kWallSlice, 0.25);
  }
  for (const Level& level : slices.levels) {
    svg.rectangle({0, level.lo}, {width, level.hi}, kBand, 0.5);
  }
  for (std::size_t i = 0; i < histogram.area_m2.size(); ++i) {
    if (histogram.area_m2[i] > 0) {
      const double z = histogram.z0 + histogram.bin_m * static_cast<double>(i);
      svg.rectangle({0, z}, {width * histogram.area_m2[i] / most, z + histogram.bin_m}, kInk);
    }
  }
  double last_label = -1e30;
  for (const Level& level : slices.levels) {
    svg.line({0, level.z}, {width, level.z}, kPeak, 1);
    const double at = std::max(level.z, last_label + 0.025 * height);  // labels of close peaks do not overlap
    last_label = at;
    char text[80];
    std::snprintf(text, sizeof text, level.cap ? "%.3f m, cap" : "%.3f m, %.0f m²",
                  scan.caption_height(level.z), level.area_m2);
    svg.text({width + 0.01 * height, at - 0.008 * height}, text, 12, kPeak);
  }
  svg.text({0, histogram.z0 - 0.025 * height},
           "area of level surface per height; longest bar " + std::to_string(std::lround(most)) + " m²", 12,
           kInk);
  return {"slice", "slice_histogram.svg", "Vertical histogram",
          "Black: area of level surface. Orange: peaks. Blue: structure slices. Yellow: wall slices.",
          svg.str()};
}

Picture draw_occupancy(const Slices& slices, std::size_t slice, const std::vector<WallLine>& lines) {
  const ScanCoordinates scan(slices.frame);
  const GridRaster grid = occupancy_raster(slices, slice);
  const double scale = std::min(60.0, 1000 / (grid.high - grid.low).maxCoeff());
  Svg svg(grid.low, grid.high, scale);
  svg.image(grid.low, grid.high, grid.image);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    svg.line(lines[i].a, lines[i].b, categorical_colour(static_cast<int>(i)), 2,
             lines[i].id + ", support " + metres(lines[i].support_m));
  }
  return {
      "detect_lines", "detect_lines_" + std::to_string(slice) + ".svg",
      "Wall slice " + std::to_string(slice) + ": " + metres(scan.caption_height(slices.levels[slice].z)) +
          " to " + metres(scan.caption_height(slices.levels[slice + 1].z)),
      "Grey: occupied cells, darker where more of the height is covered. Coloured: wall lines of all slices.",
      svg.str()};
}

}  // namespace roomcut::report

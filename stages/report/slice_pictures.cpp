// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/picture/colour_map.h"
#include "common/picture/svg.h"
#include "stages/report/pictures.h"

namespace roomcut {

namespace {

constexpr Colour kInk{40, 40, 40}, kBand{86, 180, 233}, kWallSlice{240, 228, 66}, kPeak{213, 94, 0};

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", value);
  return text;
}

/// The raster of one occupancy grid, one pixel a cell; darker = covered over more of the height.
Image occupancy_raster(const OccupancyGrid& grid, std::int32_t ix0, std::int32_t iy0, int width, int height) {
  Image image(width, height);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double coverage = std::clamp(static_cast<double>(grid.coverage[i]), 0.0, 1.0);
    const auto light = static_cast<std::uint8_t>(std::lround(225 - 195 * coverage));
    image.set(grid.ix[i] - ix0, height - 1 - (grid.iy[i] - iy0), {light, light, light});
  }
  return image;
}

}  // namespace

Picture draw_histogram(const Slices& slices) {
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
    std::snprintf(text, sizeof text, level.cap ? "%.3f m  cap" : "%.3f m  %.0f m²", level.z, level.area_m2);
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
  const double tau = slices.tau_m;
  const auto index = [tau](double v) { return static_cast<std::int32_t>(std::floor(v / tau)); };
  const std::int32_t ix0 = index(slices.bbox_min.x()) - 2, iy0 = index(slices.bbox_min.y()) - 2;
  const int width = index(slices.bbox_max.x()) + 3 - ix0, height = index(slices.bbox_max.y()) + 3 - iy0;
  const Vec2 low(ix0 * tau, iy0 * tau), high((ix0 + width) * tau, (iy0 + height) * tau);
  Svg svg(low, high, std::min(60.0, 1000 / (high - low).maxCoeff()));
  svg.image(low, high, occupancy_raster(slices.wall_slices[slice], ix0, iy0, width, height));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    svg.line(lines[i].a, lines[i].b, categorical_colour(static_cast<int>(i)), 2,
             lines[i].id + ", support " + metres(lines[i].support_m));
  }
  const std::string name = "slice_" + std::to_string(slice);
  return {
      "detect_lines", name + ".svg",
      "Wall slice " + std::to_string(slice) + ": " + metres(slices.levels[slice].z) + " to " +
          metres(slices.levels[slice + 1].z),
      "Grey: occupied cells, darker where more of the height is covered. Coloured: wall lines of all slices.",
      svg.str()};
}

Picture draw_refinement(const std::vector<WallLine>& before, const std::vector<WallLine>& after) {
  Vec2 low(1e30, 1e30), high(-1e30, -1e30);
  for (const auto* lines : {&before, &after}) {
    for (const WallLine& line : *lines) {
      low = low.cwiseMin(line.a).cwiseMin(line.b);
      high = high.cwiseMax(line.a).cwiseMax(line.b);
    }
  }
  Svg svg(low.array() - 0.5, high.array() + 0.5, std::min(60.0, 1000 / ((high - low).maxCoeff() + 1)));
  for (const WallLine& line : before) {
    svg.line(line.a, line.b, {230, 159, 0}, 3, line.id);
  }
  for (const WallLine& line : after) {
    char text[120];
    std::snprintf(text, sizeof text, "%s: offset known to %.1f mm, angle to %.3f degrees", line.id.c_str(),
                  1e3 * line.sigma_offset_m, line.sigma_angle_rad * 180 / std::numbers::pi);
    svg.line(line.a, line.b, {0, 114, 178}, 1.5, text);
  }
  return {"refine_lines", "refine_lines.svg", "Wall lines before and after refinement",
          "Orange: accepted lines. Blue: the lines that carry a wall, refined.", svg.str()};
}

}  // namespace roomcut

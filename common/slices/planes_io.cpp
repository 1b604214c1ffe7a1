// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/slices/planes_io.h"

#include <algorithm>

#include "common/artefact/h5_values.h"
#include "common/artefact/limits.h"

namespace roomcut {
namespace {

constexpr double kSteepest = 20;  ///< rise per metre, 87 degrees; `slice` finds planes of up to 68

/// Area of the triangle of three points, twice, positive when they turn left.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - b.y()) - (b.y() - a.y()) * (c.x() - b.x());
}

/// A hull that is not convex or not counter-clockwise covers nothing, and one of less than three corners has
/// no area.
void check_outline(const H5Reader& file, const std::vector<Vec2>& outline) {
  constexpr double kRounding_m2 = 1e-9;
  const std::size_t n = outline.size();
  if (n < 3) file.damaged("planes/outline_offset", "an outline has fewer than three corners");
  double area = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(outline[i], outline[(i + 1) % n], outline[(i + 2) % n]) < -kRounding_m2) {
      file.damaged("planes/outline_x", "an outline is not convex and counter-clockwise");
    }
    area += turn(outline[0], outline[i], outline[(i + 1) % n]);
  }
  if (area <= 0) file.damaged("planes/outline_x", "an outline is not counter-clockwise");
}

}  // namespace

void write_planes(H5Writer& file, const std::vector<SlopedPlane>& planes) {
  std::vector<double> gradient, c, area, rms, x, y;
  std::vector<std::uint8_t> ceiling;
  std::vector<std::uint64_t> offset{0};
  for (const SlopedPlane& plane : planes) {
    gradient.insert(gradient.end(), {plane.gradient.x(), plane.gradient.y()});
    c.push_back(plane.c);
    area.push_back(plane.area_m2);
    rms.push_back(plane.rms_m);
    ceiling.push_back(plane.ceiling ? 1 : 0);
    for (const Vec2& p : plane.outline) {
      x.push_back(p.x());
      y.push_back(p.y());
    }
    offset.push_back(x.size());
  }
  file.write("planes/gradient", std::span<const double>(gradient), {planes.size(), 2}, "1",
             "rise per metre along x and y: the plane is z = gradient . (x, y) + c");
  file.write("planes/c", c, "m", "height over the local origin");
  file.write("planes/area", area, "m^2", "surface of its points");
  file.write("planes/rms", rms, "m", "distance of its points from it, root mean square");
  file.write("planes/ceiling", ceiling, "1", "1 = seen from below, as a roof; 0 = a floor, as a ramp");
  file.write("planes/outline_offset", offset, "1", "first corner of plane i's outline");
  file.write("planes/outline_x", x, "m", "corner of the convex hull of its points, counter-clockwise");
  file.write("planes/outline_y", y, "m", "corner of the convex hull of its points, counter-clockwise");
}

std::vector<SlopedPlane> read_planes(const H5Reader& file) {
  using limits::kFarthest_m;
  if (!file.exists("planes/c")) return {};
  const auto c =
      read_in_range<double>(file, "planes/c", {0}, -kSteepest * kFarthest_m, kSteepest * kFarthest_m);
  const std::uint64_t n = c.size();
  const auto gradient = read_in_range<double>(file, "planes/gradient", {n, 2}, -kSteepest, kSteepest);
  const auto area = read_in_range<double>(file, "planes/area", {n}, 0, limits::kLargestArea_m2);
  const auto rms = read_in_range<double>(file, "planes/rms", {n}, 0, limits::kLargestNoise_m);
  const auto ceiling = read_in_range<std::uint8_t>(file, "planes/ceiling", {n}, 0, 1);
  const auto offset = file.read<std::uint64_t>("planes/outline_offset", {n + 1});
  if (offset.front() != 0 || !std::is_sorted(offset.begin(), offset.end())) {
    file.damaged("planes/outline_offset", "is not ascending from 0");
  }
  const auto corners = [&](const char* path) {
    return read_in_range<double>(file, path, {offset.back()}, -kFarthest_m, kFarthest_m);
  };
  const auto x = corners("planes/outline_x");
  const auto y = corners("planes/outline_y");
  std::vector<SlopedPlane> planes(n);
  for (std::size_t i = 0; i < n; ++i) {
    planes[i] = {{gradient[2 * i], gradient[2 * i + 1]}, c[i], {}, area[i], rms[i], ceiling[i] != 0};
    for (std::uint64_t k = offset[i]; k < offset[i + 1]; ++k) planes[i].outline.emplace_back(x[k], y[k]);
    check_outline(file, planes[i].outline);
  }
  return planes;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/slices/planes_io.h"

#include <algorithm>

#include "common/artefact/h5_values.h"
#include "common/artefact/limits.h"

namespace roomcut {

namespace {

constexpr double kSteepest = 1000;  // rise per metre: no such surface is a floor or ceiling

bool is_convex(const std::vector<Vec2>& outline) {
  constexpr double kStraight_m2 = 1e-9;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& b = outline[(i + 1) % outline.size()];
    const Vec2 in = b - outline[i];
    const Vec2 out = outline[(i + 2) % outline.size()] - b;
    if (in.x() * out.y() - in.y() * out.x() < -kStraight_m2) return false;
  }
  return outline.size() >= 3;
}

}  // namespace

void write_planes(H5Writer& file, const std::vector<SlopedPlane>& planes) {
  std::vector<double> equation, area, rms, corners;
  std::vector<std::uint8_t> ceiling;
  std::vector<std::int64_t> offset{0};
  for (const SlopedPlane& plane : planes) {
    equation.insert(equation.end(), {plane.gradient.x(), plane.gradient.y(), plane.c});
    area.push_back(plane.area_m2);
    rms.push_back(plane.rms_m);
    ceiling.push_back(plane.ceiling ? 1 : 0);
    for (const Vec2& p : plane.outline) corners.insert(corners.end(), {p.x(), p.y()});
    offset.push_back(static_cast<std::int64_t>(corners.size() / 2));
  }
  file.write("planes/equation", std::span<const double>(equation), {planes.size(), 3}, "1",
             "gx, gy (rise per metre) and c (m) of sloped floors and ceilings: z = gx x + gy y + c");
  file.write("planes/area", area, "m^2", "surface of the plane's points");
  file.write("planes/rms", rms, "m", "distance of its points from it");
  file.write("planes/ceiling", ceiling, "1", "1 = seen from below (roof, underside of a stair), 0 = floor");
  file.write("planes/outline_offset", offset, "1",
             "outline of plane i = outline_xy[outline_offset[i] .. outline_offset[i+1])");
  file.write("planes/outline_xy", std::span<const double>(corners), {corners.size() / 2, 2}, "m",
             "convex hull in plan of where its points lie, counter-clockwise");
}

std::vector<SlopedPlane> read_planes(const H5Reader& file) {
  if (!file.exists("planes/equation")) return {};
  using limits::kFarthest_m;
  const auto equation = read_in_range<double>(file, "planes/equation", {0, 3}, -kSteepest * kFarthest_m,
                                              kSteepest * kFarthest_m);
  const std::size_t n = equation.size() / 3;
  const auto area = read_in_range<double>(file, "planes/area", {n}, 0, limits::kLargestArea_m2);
  const auto rms = read_in_range<double>(file, "planes/rms", {n}, 0, limits::kLargestEdge_m);
  const auto ceiling = read_in_range<std::uint8_t>(file, "planes/ceiling", {n}, 0, 1);
  const auto offset = file.read<std::int64_t>("planes/outline_offset", {n + 1});
  const auto xy = read_in_range<double>(file, "planes/outline_xy", {0, 2}, -kFarthest_m, kFarthest_m);
  if (offset.front() != 0 || offset.back() != static_cast<std::int64_t>(xy.size() / 2) ||
      !std::is_sorted(offset.begin(), offset.end())) {
    file.damaged("planes/outline_offset", "the offsets do not fit the values");
  }
  std::vector<SlopedPlane> planes(n);
  for (std::size_t i = 0; i < n; ++i) {
    SlopedPlane& plane = planes[i];
    plane.gradient = {equation[3 * i], equation[3 * i + 1]};
    plane.c = equation[3 * i + 2];
    plane.area_m2 = area[i];
    plane.rms_m = rms[i];
    plane.ceiling = ceiling[i] != 0;
    for (auto k = static_cast<std::size_t>(offset[i]); k < static_cast<std::size_t>(offset[i + 1]); ++k) {
      plane.outline.emplace_back(xy[2 * k], xy[2 * k + 1]);
    }
    if (plane.gradient.norm() > kSteepest) file.damaged("planes/equation", "a plane stands upright");
    if (!is_convex(plane.outline)) {
      file.damaged("planes/outline_xy", "an outline is not convex and counter-clockwise");
    }
  }
  return planes;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "common/picture/svg.h"
#include "stages/tools/report/pictures.h"

namespace roomcut::report {

namespace {

constexpr Colour kBefore{230, 159, 0}, kAfter{0, 114, 178}, kWall{120, 120, 120};
constexpr Colour kCeiling{0, 158, 115}, kFloor{213, 94, 0};

std::string line_title(const WallLine& line) {
  char text[120] = "";
  if (line.sigma_offset_m > 0) {
    std::snprintf(text, sizeof text, ": offset known to %.1f mm, angle to %.3f degrees",
                  1e3 * line.sigma_offset_m, line.sigma_angle_rad * 180 / std::numbers::pi);
  }
  return line.id + text + (line.locked ? ", locked" : "");
}

struct Extent {
  Vec2 low{1e30, 1e30}, high{-1e30, -1e30};
  void add(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void add(const std::vector<WallLine>& lines) {
    for (const WallLine& line : lines) {
      add(line.a);
      add(line.b);
    }
  }
  Svg canvas() const {
    return {low.array() - 0.5, high.array() + 0.5, std::min(60.0, 1000 / ((high - low).maxCoeff() + 1))};
  }
};

std::string draw_both(const std::vector<WallLine>& before, const std::vector<WallLine>& after) {
  Extent extent;
  extent.add(before);
  extent.add(after);
  Svg svg = extent.canvas();
  for (const WallLine& line : before) {
    svg.line(line.a, line.b, kBefore, 4, line_title(line));
  }
  for (const WallLine& line : after) {
    svg.line(line.a, line.b, kAfter, 1.5, line_title(line));
  }
  return svg.str();
}

Colour colour_of(const SlopedPlane& plane) {
  return plane.ceiling ? kCeiling : kFloor;
}

/// An arrow of a metre through the middle of the outline, with the plane's name.
void draw_uphill(const PlaneFeature& feature, Svg& svg) {
  const SlopedPlane& plane = feature.plane;
  const Colour colour = colour_of(plane);
  const Vec2 middle = middle_of(plane.outline);
  const Vec2 uphill = plane.gradient.stableNormalized();
  const Vec2 side(-uphill.y(), uphill.x());
  const Vec2 tip = middle + 0.5 * uphill;
  svg.line(middle - 0.5 * uphill, tip, colour, 2);
  for (const double s : {-0.15, 0.15}) svg.line(tip, tip - 0.2 * uphill + s * side, colour, 2);
  char text[120] = "";
  std::snprintf(text, sizeof text, "%.64s %.1f deg", feature.id.c_str(),
                std::atan(plane.gradient.norm()) * 180 / std::numbers::pi);
  svg.text(middle + Vec2(0.1, 0.1), text, 12, colour);
}

}  // namespace

Picture draw_acceptance(const std::vector<WallLine>& detected, const std::vector<WallLine>& accepted) {
  return {
      "accept_lines", "accept_lines.svg", "Wall lines as detected and as accepted",
      "Orange: detected. Blue: accepted. Orange alone: moved or deleted by hand; blue alone: moved or added.",
      draw_both(detected, accepted)};
}

Picture draw_planes(const AcceptedPlanes& planes, const std::vector<WallLine>& lines) {
  Extent extent;
  extent.add(lines);
  for (const PlaneFeature& feature : planes.planes) {
    for (const Vec2& corner : feature.plane.outline) extent.add(corner);
  }
  Svg svg = extent.canvas();
  for (const WallLine& line : lines) svg.line(line.a, line.b, kWall, 1);
  for (const PlaneFeature& feature : planes.planes) {
    const PlaneNumbers numbers = numbers_of(feature.plane, planes.frame);
    char text[120] = "";
    std::snprintf(text, sizeof text, ": %.1f degrees, %.2f m high at its middle", numbers.pitch_deg,
                  numbers.height_m);
    svg.polygon(feature.plane.outline, colour_of(feature.plane), 0.25, feature.id + text);
  }
  for (const PlaneFeature& feature : planes.planes) draw_uphill(feature, svg);
  return {"accept_planes", "accept_planes.svg", "Sloped planes as accepted",
          "Green: ceilings. Orange: floors. Arrows point uphill. Grey: accepted wall lines.", svg.str()};
}

Picture draw_refinement(const std::vector<WallLine>& before, const std::vector<WallLine>& after) {
  return {"refine_lines", "refine_lines.svg", "Wall lines before and after refinement",
          "Orange: accepted lines. Blue: the lines that carry a wall, refined.", draw_both(before, after)};
}

}  // namespace roomcut::report

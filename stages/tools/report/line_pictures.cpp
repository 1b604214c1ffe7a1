// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <numbers>

#include "common/picture/svg.h"
#include "stages/tools/report/pictures.h"

namespace roomcut::report {

namespace {

constexpr Colour kBefore{230, 159, 0}, kAfter{0, 114, 178};

std::string line_title(const WallLine& line) {
  char text[120] = "";
  if (line.sigma_offset_m > 0) {
    std::snprintf(text, sizeof text, ": offset known to %.1f mm, angle to %.3f degrees",
                  1e3 * line.sigma_offset_m, line.sigma_angle_rad * 180 / std::numbers::pi);
  }
  return line.id + text + (line.locked ? ", locked" : "");
}

std::string draw_both(const std::vector<WallLine>& before, const std::vector<WallLine>& after) {
  Vec2 low(1e30, 1e30), high(-1e30, -1e30);
  for (const auto* lines : {&before, &after}) {
    for (const WallLine& line : *lines) {
      low = low.cwiseMin(line.a).cwiseMin(line.b);
      high = high.cwiseMax(line.a).cwiseMax(line.b);
    }
  }
  Svg svg(low.array() - 0.5, high.array() + 0.5, std::min(60.0, 1000 / ((high - low).maxCoeff() + 1)));
  for (const WallLine& line : before) {
    svg.line(line.a, line.b, kBefore, 4, line_title(line));
  }
  for (const WallLine& line : after) {
    svg.line(line.a, line.b, kAfter, 1.5, line_title(line));
  }
  return svg.str();
}

}  // namespace

Picture draw_acceptance(const std::vector<WallLine>& detected, const std::vector<WallLine>& accepted) {
  return {
      "accept_lines", "accept_lines.svg", "Wall lines as detected and as accepted",
      "Orange: detected. Blue: accepted. Orange alone: moved or deleted by hand; blue alone: moved or added.",
      draw_both(detected, accepted)};
}

Picture draw_refinement(const std::vector<WallLine>& before, const std::vector<WallLine>& after) {
  return {"refine_lines", "refine_lines.svg", "Wall lines before and after refinement",
          "Orange: accepted lines. Blue: the lines that carry a wall, refined.", draw_both(before, after)};
}

}  // namespace roomcut::report

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/column.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/tools/synthesize/plan.h"

namespace roomcut::synthesize {

int fine_chords(double radius, double angle) {
  const double each = 2 * std::acos(std::max(0.0, 1 - kSagitta / radius));
  return std::clamp(static_cast<int>(std::ceil(angle / each)), 3, 720);
}

int smooth_chords(const Vec2& a, const Vec2& b, const Vec2& c) {
  double length = 0;
  Vec2 last = a;
  double turn = 0;
  Vec2 heading(0, 0);
  for (const Vec2& p : arc_points(a, b, c, 64)) {
    const Vec2 step = p - last;
    if (length > 0)
      turn += std::abs(std::atan2(heading.x() * step.y() - heading.y() * step.x(), heading.dot(step)));
    length += step.norm();
    heading = step;
    last = p;
  }
  const double angle = turn * 64 / 63;
  return fine_chords(length / angle, angle);
}

SceneColumn round_column(const Vec2& centre, double diameter) {
  const int n = std::max(16, fine_chords(diameter / 2, 2 * std::numbers::pi));
  const double step = 2 * std::numbers::pi / n;
  const double radius = diameter / 2 * std::sqrt(step / std::sin(step));
  SceneColumn column{{}, centre, diameter, diameter, true};
  for (int i = 0; i < n; ++i) {
    column.polygon.emplace_back(centre + radius * Vec2(std::cos(i * step), std::sin(i * step)));
  }
  return column;
}

SceneColumn rectangular_column(const Vec2& centre, double size_x, double size_y, double rotation) {
  const Vec2 x = size_x / 2 * Vec2(std::cos(rotation), std::sin(rotation));
  const Vec2 y = size_y / 2 * Vec2(-std::sin(rotation), std::cos(rotation));
  return {{centre - x - y, centre + x - y, centre + x + y, centre - x + y}, centre, size_x, size_y, false};
}

}  // namespace roomcut::synthesize

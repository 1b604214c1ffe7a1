// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/partition/random_lines.h"

#include <cmath>
#include <numbers>
#include <string>

#include "common/random/counter_random.h"

namespace roomcut::partition {

Vec2 Motion::operator()(const Vec2& p) const {
  return Vec2(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
              std::sin(angle) * p.x() + std::cos(angle) * p.y()) +
         shift;
}

namespace {

struct Draw {
  std::uint64_t seed, stream, counter = 0;
  double operator()(double low, double high) {
    return low + (high - low) * random_unit(seed, stream, counter++);
  }
};

void any_line(Draw& draw, WallLine& line) {
  const double kind = draw(0, 1);
  const Vec2 centre(draw(0, 20), draw(0, 15));
  const double angle = kind < 0.5 ? 0 : kind < 0.9 ? 0.5 * std::numbers::pi : draw(0, std::numbers::pi);
  const double half = draw(0.3, 4);
  const Vec2 along(std::cos(angle), std::sin(angle));
  line.a = centre - half * along;
  line.b = centre + half * along;
}

void near_copy(Draw& draw, const WallLine& of, WallLine& line) {
  const double kind = draw(0, 5);
  const Vec2 normal = of.line().normal();
  const Vec2 along = (of.b - of.a).normalized();
  const double aside = kind < 1 ? 0 : kind < 2 ? 1e-9 : kind < 3 ? 1e-6 : kind < 4 ? 2e-5 : 0;
  const double turn = kind >= 4 ? 1e-7 : 0;
  line.a = of.a + aside * normal + draw(-3, 1) * along;
  line.b = of.b + aside * normal + draw(-1, 3) * along + turn * of.length() * normal;
}

void through(Draw& draw, const Vec2& point, WallLine& line) {
  const double angle = draw(0, std::numbers::pi);
  const Vec2 along(std::cos(angle), std::sin(angle));
  line.a = point - draw(0.5, 6) * along;
  line.b = point + draw(0.5, 6) * along;
}

}  // namespace

WallLines random_lines(std::uint64_t seed, int count, bool nasty, const Motion& motion) {
  WallLines lines;
  for (int i = 0; i < count; ++i) {
    Draw draw{seed, static_cast<std::uint64_t>(i)};
    WallLine line;
    line.id = "w" + std::to_string(10000 + i);
    const double kind = nasty ? draw(0, 1) : 0;
    if (kind < 0.5 || i == 0) {
      any_line(draw, line);
    } else if (kind < 0.8) {
      near_copy(draw, lines.lines[static_cast<std::size_t>(draw(0, i))], line);
    } else {
      through(draw, {9, 7}, line);
    }
    line.support_m = line.length();
    lines.lines.push_back(line);
  }
  lines.bbox_min = {1e9, 1e9};
  lines.bbox_max = {-1e9, -1e9};
  for (WallLine& line : lines.lines) {
    line.a = motion(line.a);
    line.b = motion(line.b);
  }
  for (const Vec2& corner : {Vec2(0, 0), Vec2(20, 0), Vec2(20, 15), Vec2(0, 15)}) {
    lines.bbox_min = lines.bbox_min.cwiseMin(motion(corner));
    lines.bbox_max = lines.bbox_max.cwiseMax(motion(corner));
  }
  return lines;
}

}  // namespace roomcut::partition

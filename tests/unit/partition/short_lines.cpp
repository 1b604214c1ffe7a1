// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/partition/short_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "common/random/counter_random.h"

namespace roomcut::partition {

namespace {

struct Draw {
  std::uint64_t seed, stream, counter = 0;
  double operator()(double low, double high) {
    return low + (high - low) * random_unit(seed, stream, counter++);
  }
  /// Of either sign; its magnitude is spread evenly over the powers of ten.
  double small(double least, double most) {
    const double size = std::exp(operator()(std::log(least), std::log(most)));
    return operator()(0, 1) < 0.5 ? -size : size;
  }
};

Vec2 heading(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

double any_angle(Draw& draw) {
  const double kind = draw(0, 4);
  return kind < 1 ? 0 : kind < 2 ? 0.5 * std::numbers::pi : draw(0, std::numbers::pi);
}

void set_line(WallLine& line, const Vec2& centre, double angle, double length) {
  line.a = centre - 0.5 * length * heading(angle);
  line.b = centre + 0.5 * length * heading(angle);
}

/// A line that lies to `other` as the family says.
void set_beside(ShortLines family, Draw& draw, const WallLine& other, WallLine& line) {
  const Vec2 along = (other.b - other.a).normalized();
  const Vec2 aside(-along.y(), along.x());
  const double angle = std::atan2(along.y(), along.x());
  const double length = draw(0.3, 3);
  const Vec2 on_it = other.a + draw(0, other.length()) * along;
  switch (family) {
    case ShortLines::kNearParallel:
      set_line(line, {draw(1, 39), draw(1, 29)}, angle + draw.small(1e-7, 1e-2), length);
      break;
    case ShortLines::kSmallAngles:
      set_line(line, on_it + draw(-0.5, 0.5) * along, angle + draw.small(1e-6, 1e-2), length);
      break;
    case ShortLines::kCollinear:
      set_line(line, on_it + draw(-15, 15) * along + draw.small(1e-7, 1e-4) * aside,
               angle + draw.small(1e-7, 1e-3), length);
      break;
    case ShortLines::kJunctions:
      line.a = on_it + draw.small(1e-7, 2e-5) * aside;
      line.b = line.a + length * heading(angle + draw(0.1, 3.0));
      break;
    case ShortLines::kScattered:
    case ShortLines::kColumns:
      set_line(line, {draw(0, 40), draw(0, 30)}, any_angle(draw), length);
      break;
  }
}

/// One side of one of 24 columns, six a row, 6 m apart. A hall's fits err by one scale: a row's sides then
/// nearly share a carrier, and their chords pass micrometres beside each other.
void set_column_side(Draw& draw, std::uint64_t seed, int side, WallLine& line) {
  const int column = static_cast<int>(24 * random_unit(seed, static_cast<std::uint64_t>(side), 100));
  const double size = 0.3 + 0.2 * random_unit(seed, 1000000, 0);
  const double scale = std::pow(10.0, -5 + 3 * random_unit(seed, 1000000, 1));
  const Vec2 centre(5 + 6 * (column % 6), 5 + 6 * (column / 6 % 4));
  const double angle = 0.5 * std::numbers::pi * (side % 4);
  const Vec2 out = heading(angle - 0.5 * std::numbers::pi);
  set_line(line, centre + (0.5 * size + scale * draw(-1, 1)) * out, angle + scale * draw(-1, 1),
           draw(0.8, 1) * size);
}

Vec2 as_stored(const Vec2& p) {
  return (p * 1e6).array().round() / 1e6;
}

}  // namespace

WallLines short_lines(ShortLines family, std::uint64_t seed, int count) {
  WallLines lines;
  lines.bbox_min = {0, 0};
  lines.bbox_max = {40, 30};
  for (int i = 0; i < count; ++i) {
    Draw draw{seed, static_cast<std::uint64_t>(i)};
    WallLine line;
    line.id = "w" + std::to_string(10000 + i);
    if (family == ShortLines::kColumns) {
      set_column_side(draw, seed, i, line);
    } else if (i < (family == ShortLines::kCollinear ? 6 : 2)) {
      set_line(line, {draw(2, 38), draw(2, 28)}, any_angle(draw), draw(0.3, 3));
    } else {
      const int others = family == ShortLines::kNearParallel ? 2 : family == ShortLines::kCollinear ? 6 : i;
      const auto other = static_cast<std::size_t>(draw(0, std::min(others, i)));
      set_beside(family, draw, lines.lines[other], line);
    }
    line.a = as_stored(line.a);
    line.b = as_stored(line.b);
    line.support_m = line.length();
    lines.lines.push_back(line);
  }
  return lines;
}

}  // namespace roomcut::partition

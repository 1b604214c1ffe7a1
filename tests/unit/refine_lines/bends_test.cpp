// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/bends.h"

#include <gtest/gtest.h>

#include "tests/unit/refine_lines/made_points.h"

namespace roomcut::refine_lines {
using namespace roomcut::testing;

namespace {

using testing::kDeg;
using testing::Normal;
using testing::whole_line;

constexpr double kNoise_m = 0.001;  ///< of an observation

/// What is observed of the wall from `a` to `b` by a line that carries its surface there, four heights a bin.
void observe(const Vec2& a, const Vec2& b, const LineFaces& faces, Normal& random,
             std::vector<Observation>& observations) {
  const Line2 wall = line_through(a, b);
  const auto count = static_cast<int>((b - a).norm() / faces.bin_m);
  for (int i = 0; i < count; ++i) {
    for (int zone = 0; zone < 4; ++zone) {
      const Vec2 p = a + (i + 0.5) / count * (b - a) + random(kNoise_m) * wall.normal();
      const double t = (faces.line.along(p) - faces.t0) / faces.bin_m;
      if (t >= 0 && t < static_cast<double>(faces.bins)) {
        observations.push_back({p, kNoise_m * kNoise_m, 9e-6, 20, zone, static_cast<std::size_t>(t), 0});
      }
    }
  }
}

/// Three walls of 0.8 m, each turned by `turn` from the one before; the middle one has no line.
struct Curve {
  explicit Curve(double turn) {
    const Vec2 along(std::cos(turn), std::sin(turn));
    const Vec2 last(std::cos(2 * turn), std::sin(2 * turn));
    corner[0] = {0, 0};
    corner[1] = {0.8, 0};
    corner[2] = corner[1] + 0.8 * along;
    corner[3] = corner[2] + 0.8 * last;
    const Vec2 middle = 0.5 * (corner[1] + corner[2]);
    for (const int i : {0, 2}) {
      const Line2 line = line_through(corner[i], corner[i + 1]);
      const double t[3] = {line.along(corner[i]), line.along(corner[i + 1]), line.along(middle)};
      faces[i / 2] = whole_line(line, *std::min_element(t, t + 3), *std::max_element(t, t + 3));
      Normal random(static_cast<std::uint64_t>(i) + 1);
      observe(corner[i], corner[i + 1], faces[i / 2], random, observations[i / 2]);
      const Vec2 from = i == 0 ? corner[1] : middle;
      observe(from, from + 0.4 * along, faces[i / 2], random, observations[i / 2]);
    }
  }
  std::vector<Bend> bends() const {
    return find_bends(
        {{faces[0].line, &faces[0], &observations[0]}, {faces[1].line, &faces[1], &observations[1]}}, {2.5});
  }
  Vec2 corner[4];
  LineFaces faces[2];
  std::vector<Observation> observations[2];
};

TEST(Bends, TheWallBetweenTwoLinesIsFoundOnceFromBoth) {
  for (const double turn : {5 * kDeg, 7 * kDeg, 10 * kDeg}) {
    const Curve curve(turn);
    const std::vector<Bend> found = curve.bends();
    ASSERT_EQ(found.size(), 1U) << turn;
    const Line2 truth = line_through(curve.corner[1], curve.corner[2]);
    EXPECT_LT(angle_between(found[0].faces.line.theta, truth.theta), 0.5 * kDeg);
    EXPECT_NEAR(found[0].faces.line.distance(0.5 * (curve.corner[1] + curve.corner[2])), 0, 0.001);
    EXPECT_GT(found[0].faces.t1 - found[0].faces.t0, 0.5);
    EXPECT_NE(found[0].faces.side_at(0, 0), 0);
    for (const Observation& o : found[0].observations) EXPECT_LT(o.bin, found[0].faces.bins);
  }
}

TEST(Bends, AStraightWallHasNone) {
  EXPECT_TRUE(Curve(0).bends().empty());
  EXPECT_TRUE(Curve(1 * kDeg).bends().empty());
}

TEST(Bends, WhatStandsBeforeTheWallWithoutMeetingItIsNone) {
  const LineFaces faces = whole_line({0.3, 2}, 0, 4);
  const Vec2 off = faces.line.normal();
  for (const double turn : {0.0, 6 * kDeg}) {
    std::vector<Observation> observations;
    Normal random(7);
    observe(faces.line.at(0), faces.line.at(2), faces, random, observations);
    observe(faces.line.at(2) + 0.03 * off, faces.line.at(2.5) + (0.03 + 0.5 * turn) * off, faces, random,
            observations);
    observe(faces.line.at(2.5), faces.line.at(4), faces, random, observations);
    EXPECT_TRUE(find_bends({{faces.line, &faces, &observations}}, {2.5}).empty()) << turn;
  }
}

}  // namespace
}  // namespace roomcut::refine_lines

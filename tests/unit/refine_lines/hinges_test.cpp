// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/hinges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/refine_lines/made_points.h"

namespace roomcut::refine_lines {
using namespace roomcut::testing;

namespace {

using testing::kDeg;
using testing::Normal;
using testing::whole_line;

constexpr double kNoise_m = 0.001;  ///< of an observation

/// Two chords of 0.9 m, the second turned by `turn`, and the line that detection laid across both.
struct TwoChords {
  explicit TwoChords(double turn, double step_m = 0) {
    const Vec2 along(std::cos(turn), std::sin(turn));
    corner[0] = {0, 0};
    corner[1] = {0.9, 0};
    corner[2] = corner[1] + 0.9 * along;
    line = line_through(corner[0], corner[2]);
    const double from = std::min(line.along(corner[0]), line.along(corner[2]));
    faces = whole_line(line, from, from + (corner[2] - corner[0]).norm());
    Normal random(5);
    for (int i = 0; i < 18; ++i) {
      const Vec2 p = i < 9
                         ? Vec2(corner[0] + (i + 0.5) / 9 * (corner[1] - corner[0]))
                         : Vec2(corner[1] + (i - 8.5) / 9 * (corner[2] - corner[1]) + step_m * line.normal());
      for (int zone = 0; zone < 4; ++zone) {
        const Vec2 seen = p + random(kNoise_m) * line.normal();
        const double bin = (line.along(seen) - faces.t0) / faces.bin_m;
        observations.push_back({seen, kNoise_m * kNoise_m, 9e-6, 20, zone,
                                std::min(faces.bins - 1, static_cast<std::size_t>(std::max(0.0, bin))), 0});
      }
    }
  }
  std::optional<Hinge> hinge() const { return find_hinge({line, &faces, &observations}); }
  Vec2 corner[3];
  Line2 line;
  LineFaces faces;
  std::vector<Observation> observations;
};

TEST(Hinges, ALineAcrossTwoChordsIsCutWhereTheyMeet) {
  for (const double turn : {4 * kDeg, 6 * kDeg, 10 * kDeg}) {
    const TwoChords scene(turn);
    const std::optional<Hinge> found = scene.hinge();
    ASSERT_TRUE(found) << turn;
    const double at = scene.faces.t0 + static_cast<double>(found->bin) * scene.faces.bin_m;
    EXPECT_NEAR(at, scene.line.along(scene.corner[1]), scene.faces.bin_m);
    const bool forward = scene.line.along(scene.corner[0]) < scene.line.along(scene.corner[2]);
    const Line2& first = forward ? found->before : found->behind;
    const Line2& second = forward ? found->behind : found->before;
    EXPECT_LT(std::abs(first.distance({0.45, 0})), 0.001);
    EXPECT_LT(angle_between(first.theta, line_through(scene.corner[0], scene.corner[1]).theta), 0.3 * kDeg);
    EXPECT_LT(angle_between(second.theta, line_through(scene.corner[1], scene.corner[2]).theta), 0.3 * kDeg);
  }
}

TEST(Hinges, AStraightWallAndOneThatIsHardlyBentHaveNone) {
  EXPECT_FALSE(TwoChords(0).hinge());
  EXPECT_FALSE(TwoChords(1.5 * kDeg).hinge());
}

TEST(Hinges, WhatStandsBesideTheWallIsNone) {
  EXPECT_FALSE(TwoChords(0, 0.03).hinge());
  EXPECT_FALSE(TwoChords(5 * kDeg, 0.03).hinge());
}

}  // namespace
}  // namespace roomcut::refine_lines

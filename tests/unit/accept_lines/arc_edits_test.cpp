// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/accept_lines/arc_edits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/wall_lines/wall_arc.h"
#include "stages/accept_lines/accept_lines.h"

namespace roomcut::accept_lines {
namespace {

const WallArc kArc{"a0001", {1, 2}, 3};

/// Four chords of an arc, and a straight wall, in a frame far from the scan's origin.
WallLines walls() {
  WallLines lines;
  lines.frame.origin[0] = 1000;
  lines.frame.origin[1] = 2000;
  const auto corner = [](int k) -> Vec2 {
    return kArc.centre + kArc.radius_m * Vec2(std::cos(0.1 * k), std::sin(0.1 * k));
  };
  for (int k = 0; k < 4; ++k) {
    WallLine line;
    line.id = "w000" + std::to_string(k + 1);
    line.a = corner(k);
    line.b = corner(k + 1);
    set_arc(line, kArc, lines.frame);
    lines.lines.push_back(line);
  }
  WallLine straight;
  straight.id = "w0005";
  straight.a = {0, 0};
  straight.b = {5, 0};
  lines.lines.push_back(straight);
  return lines;
}

WallLines accepted(const WallLines& edit) {
  return accept_lines(walls(), "digest", edit).lines;
}

TEST(ArcEdits, TheArcSurvivesItsPropertiesInTheScansCoordinates) {
  const WallLines lines = walls();
  EXPECT_NE(lines.lines[0].extra_json.find("\"arc_x\":1001.0"), std::string::npos)
      << lines.lines[0].extra_json;
  const auto arc = arc_of(lines.lines[0], lines.frame);
  ASSERT_TRUE(arc);
  EXPECT_EQ(arc->id, "a0001");
  EXPECT_NEAR((arc->centre - kArc.centre).norm(), 0, 1e-9);
  EXPECT_FALSE(arc_of(lines.lines[4], lines.frame));
}

TEST(ArcEdits, AnUntouchedArcStaysAsItIs) {
  const WallLines result = accepted(walls());
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(result.lines[k].extra_json, walls().lines[k].extra_json);
    EXPECT_EQ(result.lines[k].source, LineSource::kDetected);
  }
}

TEST(ArcEdits, AnotherRadiusOnOneChordMakesAllChordsAnew) {
  WallLines edit = walls();
  set_arc(edit.lines[2], WallArc{"a0001", kArc.centre, 3.3}, edit.frame);
  const WallLines result = accepted(edit);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR((result.lines[k].a - kArc.centre).norm(), 3.3, 1e-9) << k;
    EXPECT_NEAR(arc_of(result.lines[k], result.frame)->radius_m, 3.3, 1e-9) << k;
    EXPECT_EQ(result.lines[k].source, LineSource::kEdited) << k;
  }
  EXPECT_NEAR((result.lines[0].b - result.lines[1].a).norm(), 0, 1e-9);
  EXPECT_EQ(accept_lines(walls(), "digest", edit).arcs.size(), 1U);
}

TEST(ArcEdits, AnotherCentreMovesAllChordsButNotTheRest) {
  WallLines edit = walls();
  for (int k = 0; k < 4; ++k) {
    set_arc(edit.lines[k], WallArc{"a0001", kArc.centre + Vec2(0.5, 0), 3}, edit.frame);
  }
  const WallLines result = accepted(edit);
  EXPECT_NEAR((result.lines[3].a - edit.lines[3].a - Vec2(0.5, 0)).norm(), 0, 1e-9);
  EXPECT_EQ(result.lines[4].source, LineSource::kDetected);
}

TEST(ArcEdits, ContradictingRadiiAreSaidAndTheFirstChordsCounts) {
  WallLines edit = walls();
  set_arc(edit.lines[1], WallArc{"a0001", kArc.centre, 3.1}, edit.frame);
  set_arc(edit.lines[2], WallArc{"a0001", kArc.centre, 3.2}, edit.frame);
  const Acceptance acceptance = accept_lines(walls(), "digest", edit);
  EXPECT_EQ(acceptance.arcs.size(), 2U);
  EXPECT_NEAR(arc_of(acceptance.lines.lines[3], edit.frame)->radius_m, 3.1, 1e-9);
}

TEST(ArcEdits, AMovedChordAndACopyLeaveTheArcAndADeletedOneIsGone) {
  WallLines edit = walls();
  edit.lines[0].a.y() += 0.2;
  WallLine copy = edit.lines[1];
  copy.id = "w0009";
  copy.a.y() += 1;
  edit.lines.push_back(copy);
  edit.lines.erase(edit.lines.begin() + 2);
  const WallLines result = accepted(edit);
  ASSERT_EQ(result.lines.size(), 5U);
  EXPECT_FALSE(arc_of(result.lines[0], result.frame));
  EXPECT_TRUE(arc_of(result.lines[1], result.frame));
  EXPECT_EQ(result.lines[2].id, "w0004");
  EXPECT_FALSE(arc_of(result.lines[4], result.frame));
}

TEST(ArcEdits, NumbersAsTextCountAndIncompleteArcsAreNone) {
  WallLine line = walls().lines[0];
  line.extra_json = R"({"arc_id":"a1","arc_radius_m":"2.5","arc_x":"1000","arc_y":2000})";
  ASSERT_TRUE(arc_of(line, walls().frame));
  EXPECT_NEAR(arc_of(line, walls().frame)->radius_m, 2.5, 1e-12);
  line.extra_json = R"({"arc_id":"a1","arc_radius_m":"wide","arc_x":1000,"arc_y":2000})";
  EXPECT_FALSE(arc_of(line, walls().frame));
}

}  // namespace
}  // namespace roomcut::accept_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/accept_lines/accept_lines.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace roomcut::accept_lines {
namespace {

WallLine make_line(const std::string& id, Vec2 a, Vec2 b) {
  WallLine line;
  line.id = id;
  line.a = a;
  line.b = b;
  return line;
}

/// A room of 5 x 4 m.
WallLines room() {
  WallLines lines;
  lines.lines = {make_line("w0001", {0, 0}, {5, 0}), make_line("w0002", {5, 0}, {5, 4}),
                 make_line("w0003", {0, 4}, {5, 4}), make_line("w0004", {0, 0}, {0, 4})};
  return lines;
}

TEST(AcceptLines, WithoutAnEditTheDetectedLinesGoThroughAndNameTheirDigest) {
  const Acceptance accepted = accept_lines(room(), "digest", std::nullopt);
  EXPECT_EQ(accepted.lines.lines.size(), 4U);
  EXPECT_EQ(accepted.lines.base_sha256, "digest");
  EXPECT_FALSE(accepted.base_moved);
  EXPECT_TRUE(accepted.changes.moved.empty());
}

TEST(AcceptLines, TheEditWinsAndIsComparedWithTheDetection) {
  WallLines edit = room();
  edit.base_sha256 = "digest";
  edit.lines[1].a.x() = edit.lines[1].b.x() = 5.2;
  edit.lines.erase(edit.lines.begin());
  edit.lines.push_back(make_line("x", {1, 1}, {2, 1}));
  edit.lines.back().locked = true;
  const Acceptance accepted = accept_lines(room(), "digest", edit);
  EXPECT_EQ(accepted.lines.lines.size(), 4U);
  ASSERT_EQ(accepted.changes.moved.size(), 1U);
  EXPECT_NEAR(accepted.changes.moved[0].offset_m, 0.2, 1e-12);
  EXPECT_EQ(accepted.changes.added, std::vector<std::string>{"x"});
  EXPECT_EQ(accepted.changes.deleted, std::vector<std::string>{"w0001"});
  EXPECT_EQ(accepted.locked, 1);
  EXPECT_FALSE(accepted.base_moved);
}

TEST(AcceptLines, AnEditThatNamesNoBaseBeganFromThisDetection) {
  const Acceptance accepted = accept_lines(room(), "digest", room());
  EXPECT_FALSE(accepted.base_moved);
  EXPECT_EQ(accepted.lines.base_sha256, "digest");
}

TEST(AcceptLines, AMovedBaseIsToldWithWhatTheDetectionAddsAndDrops) {
  WallLines edit = room();
  edit.base_sha256 = "old";
  WallLines detected = room();
  detected.lines[0].a.y() = detected.lines[0].b.y() = 0.01;  // the same wall, found again a little off
  detected.lines[3].a.x() = detected.lines[3].b.x() = 0.5;   // another wall
  const Acceptance accepted = accept_lines(detected, "new", edit);
  EXPECT_TRUE(accepted.base_moved);
  EXPECT_EQ(accepted.lines.base_sha256, "old");
  ASSERT_EQ(accepted.only_detected.size(), 1U);
  EXPECT_EQ(accepted.only_detected[0].a.x(), 0.5);
  ASSERT_EQ(accepted.only_edited.size(), 1U);
  EXPECT_EQ(accepted.only_edited[0].a.x(), 0);
}

TEST(WithoutPartner, TheTwoFacesOfAThinWallAreNotPartners) {
  const std::vector<WallLine> face{make_line("a", {0, 0}, {5, 0})};
  EXPECT_EQ(without_partner(face, {make_line("b", {0, 0.06}, {5, 0.06})}).size(), 1U);
  EXPECT_TRUE(without_partner(face, {make_line("b", {4, 0.02}, {1, 0.02})}).empty());
}

TEST(WithoutPartner, CollinearLinesWithoutACommonStretchAreNotPartners) {
  const std::vector<WallLine> line{make_line("a", {0, 0}, {5, 0})};
  EXPECT_EQ(without_partner(line, {make_line("b", {6, 0}, {9, 0})}).size(), 1U);
}

TEST(WithoutPartner, AnObliqueLineThroughTheCentreIsNone) {
  const std::vector<WallLine> line{make_line("a", {0, 0}, {5, 0})};
  EXPECT_EQ(without_partner(line, {make_line("b", {0, -0.25}, {5, 0.25})}).size(), 1U);
}

TEST(DescribeMovedBase, ListsAtMostTwentyLinesAndSaysHowManyMore) {
  Acceptance accepted;
  accepted.base_moved = true;
  for (int i = 0; i < 33; ++i) {
    accepted.only_detected.push_back(make_line("w" + std::to_string(i), {0, 0}, {1, 0}));
  }
  const std::string text = describe_moved_base(accepted, "abc");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 21);
  EXPECT_NE(text.find("13 more"), std::string::npos);
  EXPECT_NE(text.find("\"base_sha256\": \"abc\""), std::string::npos);
}

}  // namespace
}  // namespace roomcut::accept_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/describe_changes.h"

#include <gtest/gtest.h>

namespace roomcut {
namespace {

WallLine make_line(const std::string& id, Vec2 a, Vec2 b) {
  WallLine line;
  line.id = id;
  line.a = a;
  line.b = b;
  return line;
}

TEST(DescribeChanges, SaysByHowMuchALineMoved) {
  EXPECT_EQ(describe(LineMove{"w0007", 0.104, 0, 0.104}), "w0007 moved by 104.0 mm, turned by 0.00 deg");
  EXPECT_EQ(describe(LineMove{"w0007", 0, 0, 1.5}), "w0007 kept its place, its ends moved by 1500.0 mm");
}

TEST(DescribeChanges, NamesEveryChangedLineAndCountsAll) {
  const std::vector<WallLine> detected{make_line("w0001", {0, 0}, {4, 0}),
                                       make_line("w0002", {0, 3}, {4, 3})};
  const std::vector<WallLine> edited{make_line("e0001", {1, 1}, {2, 1}),
                                     make_line("w0001", {0, 0.5}, {4, 0.5})};
  const auto text = describe_changes(compare_lines(detected, edited), detected, edited, {});
  ASSERT_EQ(text.size(), 4U);
  EXPECT_NE(text[0].find("w0001 moved by 500.0 mm"), std::string::npos);
  EXPECT_NE(text[1].find("e0001 (1.00 m, from (1.00, 1.00) to (2.00, 1.00))"), std::string::npos);
  EXPECT_NE(text[2].find("w0002"), std::string::npos);
  EXPECT_EQ(text[3], "0 as detected, 1 moved, 1 added, 1 deleted, 0 locked");
}

TEST(DescribeChanges, SaysPlacesInTheScansOwnCoordinates) {
  const std::vector<WallLine> detected{make_line("w0001", {0, 0}, {4, 0})};
  Frame frame;
  frame.origin[0] = 691234.5;
  frame.origin[1] = 5334567.25;
  const auto text = describe_changes(compare_lines(detected, {}), detected, {}, frame);
  EXPECT_NE(text[0].find("from (691234.50, 5334567.25) to (691238.50, 5334567.25)"), std::string::npos)
      << text[0];
}

TEST(DescribeChanges, NamesEveryLockedLine) {
  std::vector<WallLine> lines{make_line("w0001", {0, 0}, {4, 0}), make_line("w0002", {0, 3}, {4, 3})};
  const std::vector<WallLine> detected = lines;
  lines[1].locked = true;
  const auto text = describe_changes(compare_lines(detected, lines), detected, lines, {});
  ASSERT_EQ(text.size(), 2U);
  EXPECT_EQ(text[0], "locked:  w0002 (4.00 m, from (0.00, 3.00) to (4.00, 3.00))");
  EXPECT_EQ(text[1], "2 as detected, 0 moved, 0 added, 0 deleted, 1 locked");
}

}  // namespace
}  // namespace roomcut

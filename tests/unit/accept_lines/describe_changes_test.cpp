// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/accept_lines/describe_changes.h"

#include <gtest/gtest.h>

#include <algorithm>

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
  EXPECT_EQ(describe(LineMove{"w0007", 0.104, 0, 0.104}), "w0007 moved by 0.104 m, turned by 0.00 deg");
  EXPECT_EQ(describe(LineMove{"w0007", 0, 0, 1.5}), "w0007 kept its place, its ends moved by 1.500 m");
}

TEST(DescribeChanges, NamesEveryChangedLineAndCountsAll) {
  const std::vector<WallLine> detected{make_line("w0001", {0, 0}, {4, 0}),
                                       make_line("w0002", {0, 3}, {4, 3})};
  const std::vector<WallLine> edited{make_line("e0001", {1, 1}, {2, 1}),
                                     make_line("w0001", {0, 0.5}, {4, 0.5})};
  const auto text = describe_changes(compare_lines(detected, edited), detected, edited);
  ASSERT_EQ(text.size(), 4U);
  EXPECT_NE(text[0].find("w0001 moved by 0.500 m"), std::string::npos);
  EXPECT_NE(text[1].find("e0001 (1.00 m, from (1.00, 1.00) to (2.00, 1.00))"), std::string::npos);
  EXPECT_NE(text[2].find("w0002"), std::string::npos);
  EXPECT_EQ(text[3], "0 as detected, 1 moved, 1 added, 1 deleted, 0 locked");
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
}  // namespace roomcut

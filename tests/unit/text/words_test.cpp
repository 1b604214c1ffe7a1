// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/text/words.h"

#include <gtest/gtest.h>

namespace roomcut {
namespace {

using Words = std::vector<std::string_view>;

TEST(Trimmed, OnlyWhatStandsAroundTheTextIsBlank) {
  EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed(" \t\r\n"), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Split, PiecesAreTrimmedAndMayBeEmpty) {
  EXPECT_EQ(split("a | b b ||", '|'), (Words{"a", "b b", "", ""}));
  EXPECT_EQ(split("", '|'), Words{""});
}

TEST(Split, BetweenBlanksNothingIsEmpty) {
  EXPECT_EQ(split("  a  b ", ' '), (Words{"a", "b"}));
  EXPECT_EQ(split("   ", ' '), Words{});
}

}  // namespace
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/duplicate_keys.h"

#include <gtest/gtest.h>

#include "common/artefact/json_values.h"

namespace roomcut {
namespace {

TEST(DuplicateKeys, AreFoundWithTheirPlace) {
  const auto found = find_duplicate_keys(
      R"({"a": 1, "features": [{"p": {"x": 1}}, {"p": {"x": 1, "y": [], "x": 2, "x": 3}}], "a": {}})", 20);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].object, "features[1].p");
  EXPECT_EQ(found[0].key, "x");
  EXPECT_EQ(found[1].object, "");
  EXPECT_EQ(found[1].key, "a");
}

TEST(DuplicateKeys, TheSameKeyInTwoObjectsIsFine) {
  EXPECT_TRUE(find_duplicate_keys(R"([{"x": 1}, {"x": {"x": [1, 2, {"x": 3}]}}])", 20).empty());
}

TEST(DuplicateKeys, AreNotMoreThanAskedFor) {
  std::string text = "{";
  for (int i = 0; i < 100; ++i) text += R"("k)" + std::to_string(i / 2) + R"(": 0,)";
  text += R"("": 0})";
  EXPECT_EQ(find_duplicate_keys(text, 20).size(), 20U);
  EXPECT_EQ(find_duplicate_keys(text, 20).back().key, "k19");
}

TEST(DuplicateKeys, LongNamesAreCutBetweenLetters) {
  std::string name = "x";
  for (int i = 0; i < 1000; ++i) name += "ä";
  const std::string inner = R"({"k": 1, "k": 2})";
  const auto found = find_duplicate_keys(R"({")" + name + R"(": )" + inner + "}", 20);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(found[0].object.size(), 100U);
  EXPECT_TRUE(is_utf8(found[0].object));
}

}  // namespace
}  // namespace roomcut

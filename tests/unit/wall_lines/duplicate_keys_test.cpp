// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/duplicate_keys.h"

#include <gtest/gtest.h>

namespace roomcut {
namespace {

TEST(DuplicateKeys, AreFoundWithTheirPlace) {
  const auto found = find_duplicate_keys(
      R"({"a": 1, "features": [{"p": {"x": 1}}, {"p": {"x": 1, "y": [], "x": 2, "x": 3}}], "a": {}})");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].object, "features[1].p");
  EXPECT_EQ(found[0].key, "x");
  EXPECT_EQ(found[1].object, "");
  EXPECT_EQ(found[1].key, "a");
}

TEST(DuplicateKeys, TheSameKeyInTwoObjectsIsFine) {
  EXPECT_TRUE(find_duplicate_keys(R"([{"x": 1}, {"x": {"x": [1, 2, {"x": 3}]}}])").empty());
}

}  // namespace
}  // namespace roomcut

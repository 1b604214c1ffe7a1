// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "common/artefact_tool/status.h"

namespace roomcut {
namespace {

using Words = std::vector<std::string>;

TEST(Status, NamesEveryParameterThatDiffers) {
  EXPECT_EQ(
      describe_parameters(R"({"a":1,"mu_m":0.3,"old":2})", R"({"a":1,"mu_m":0.5,"new":"auto"})"),
      (Words{"parameter mu_m changed 0.3 -> 0.5", "parameter new is new (auto)", "parameter old is gone"}));
  EXPECT_TRUE(describe_parameters(R"({"a":1})", R"({"a":1})").empty());
  EXPECT_TRUE(describe_parameters("", "{}").empty());
}

}  // namespace
}  // namespace roomcut

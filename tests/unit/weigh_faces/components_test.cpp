// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/components.h"

#include <gtest/gtest.h>

namespace roomcut {
namespace {

TEST(FindComponents, SeparatesRegionsThatTouchAtACornerOnly) {
  const std::vector<std::uint8_t> bins = {1, 1, 0, 0,  //
                                          0, 0, 1, 0,  //
                                          0, 0, 1, 0};
  const Components c = find_components(bins, 4, 3);
  EXPECT_EQ(c.count, 2);
  EXPECT_EQ(c.grown[0], 0);
  EXPECT_EQ(c.grown[1], 0);
  EXPECT_EQ(c.grown[6], 1);
  EXPECT_EQ(c.grown[10], 1);
}

TEST(FindComponents, GrowsByOneBinAndTheLowestNumberWins) {
  const std::vector<std::uint8_t> bins = {1, 0, 1, 0, 0};
  const Components c = find_components(bins, 5, 1);
  EXPECT_EQ(c.grown, (std::vector<std::int32_t>{0, 0, 1, 1, -1}));
}

}  // namespace
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/regions.h"

#include <gtest/gtest.h>

#include "tests/unit/extract/grid_complex.h"

namespace roomcut::fit_surfaces {
namespace {

TEST(Regions, FloorsEndAtWallsAndWhereTheEmptySideChanges) {
  // Two rooms of two faces each with a wall between; over the right half of the first a room of the upper
  // layer, whose floor is on the level of no other.
  const CellComplex complex = test::grid_complex({0, 1, 3, 5, 5.2, 7, 9, 10}, {0, 1, 3, 4}, {0, 3, 6});
  const Labels labels = test::label_where(complex, [](const Vec2& p, double z) {
    const bool row = p.y() > 1 && p.y() < 3;
    const bool lower = z < 3 && ((p.x() > 1 && p.x() < 5) || (p.x() > 5.2 && p.x() < 9));
    return row && (lower || (z > 3 && p.x() > 3 && p.x() < 5));
  });
  const Seats seats(complex, labels.label);
  const std::vector<Region> regions = find_regions(complex, seats, choose_seats(complex, seats, {}));
  // Floors of both rooms; ceilings of the first room's left half and of the second; the upper room's ceiling:
  // between it and the room below there is no slab.
  ASSERT_EQ(regions.size(), 5U);
  EXPECT_EQ(regions[0].faces.size(), 2U);
  EXPECT_EQ(regions[1].faces.size(), 2U);
  EXPECT_FALSE(regions[0].ceiling);
  EXPECT_EQ(regions[2].level, 1);
  EXPECT_TRUE(regions[2].ceiling);
  EXPECT_EQ(regions[2].faces.size(), 1U);
  EXPECT_EQ(regions[3].faces.size(), 2U);
  EXPECT_EQ(regions[4].level, 2);
}

}  // namespace
}  // namespace roomcut::fit_surfaces

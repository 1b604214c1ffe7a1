// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/storeys.h"

#include <gtest/gtest.h>

#include "stages/extract/rooms.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut::extract {
namespace {

using test::grid_complex;
using test::label_where;

// A row of 4 m x 5 m bays with walls of 0.5 m between them; empty(bay, z).
struct Row {
  CellComplex complex;
  Labels labels;
};
Row row(const std::vector<double>& levels, const std::function<bool(int, double)>& empty) {
  Row out{grid_complex({0, 0.5, 4.5, 5, 9, 9.5, 13.5, 14}, {0, 0.5, 5.5, 6}, levels), {}};
  out.labels = label_where(out.complex, [&](const Vec2& p, double z) {
    const double along = p.x() - 0.5;
    const int bay = static_cast<int>(along / 4.5);
    return p.y() > 0.5 && p.y() < 5.5 && along > 0 && along - 4.5 * bay < 4 && empty(bay, z);
  });
  return out;
}

TEST(Storeys, FloorsOfOneStoreyMayLieAtDifferentHeights) {
  const Row r = row({0, 0.15, 2.4, 2.7, 2.85, 3.1, 5.7, 6.2}, [](int bay, double z) {
    return bay == 0 ? (z < 2.4 || (z > 2.85 && z < 5.7)) : (z > 0.15 && z < 2.7) || z > 3.1;
  });
  const Storeys storeys = find_storeys(r.complex, r.labels.label, {});
  ASSERT_EQ(storeys.floor_z.size(), 2U);
  EXPECT_DOUBLE_EQ(storeys.floor_z[0], 0.15);  // two of the three bays
  EXPECT_DOUBLE_EQ(storeys.floor_z[1], 3.1);
  const auto rooms = find_rooms(EndHeights(r.complex), r.labels, storeys).spaces;
  ASSERT_EQ(rooms.size(), 6U);
  EXPECT_EQ(rooms[2].storey, 0);
  EXPECT_EQ(rooms[3].storey, 1);
  EXPECT_NEAR(rooms[3].volume_m3, 20 * 3.1, 1e-9);
  EXPECT_NEAR(rooms[3].height(), 3.1, 1e-9);
}

TEST(Storeys, AHallThroughBothStoreysCountsForTheLowerOne) {
  const Row r = row({0, 2.7, 3, 6}, [](int bay, double z) { return bay == 2 || z < 2.7 || z > 3; });
  const Storeys storeys = find_storeys(r.complex, r.labels.label, {});
  ASSERT_EQ(storeys.floor_z.size(), 2U);
  const auto levels = measure_storeys(EndHeights(r.complex), r.labels, storeys);
  EXPECT_NEAR(levels[0].area_m2, 60, 1e-9);
  EXPECT_NEAR(levels[1].area_m2, 40, 1e-9);
  EXPECT_NEAR(levels[0].volume_m3, 2 * 20 * 2.7 + 20 * 6, 1e-9);
}

TEST(Storeys, AHighNicheWithLittleFloorIsNoStorey) {
  const Row r = row({0, 2, 2.6, 5}, [](int bay, double z) { return bay == 0 ? z > 2 && z < 2.6 : z < 2.6; });
  StoreyParams params;
  params.least_floor_m2 = 25;
  const Storeys storeys = find_storeys(r.complex, r.labels.label, params);
  EXPECT_EQ(storeys.floor_z, std::vector<double>{0});
}

TEST(Storeys, TheSpaceAboveACupboardBelongsToItsRoomsStorey) {
  // Its floor is nearer to the upper storey's floor, but it ends below it.
  const Row r = row({0, 2.3, 2.7, 3, 6},
                    [](int bay, double z) { return bay == 0 ? z > 2.3 && z < 2.7 : (z < 2.7 || z > 3); });
  const Storeys storeys = find_storeys(r.complex, r.labels.label, {});
  ASSERT_EQ(storeys.floor_z.size(), 2U);
  EXPECT_EQ(storeys.of_cell[r.complex.cell(8, 1)], 0);
}

TEST(Storeys, RoomsAndStoreysAddUpToTheEmptyVolume) {
  Row r = row({0, 2.7, 3, 6}, [](int bay, double z) { return bay == 1 || z < 2.7 || z > 3; });
  r.labels.unobserved.assign(r.complex.cells(), 1);
  const Storeys storeys = find_storeys(r.complex, r.labels.label, {});
  double rooms = 0, levels = 0, unobserved = 0;
  for (const Space& room : find_rooms(EndHeights(r.complex), r.labels, storeys).spaces) {
    rooms += room.volume_m3;
    unobserved += room.unobserved_m3;
  }
  for (const Space& storey : measure_storeys(EndHeights(r.complex), r.labels, storeys))
    levels += storey.volume_m3;
  const double expected = 20 * (2 * (2.7 + 3) + 6);
  EXPECT_NEAR(rooms, expected, 1e-9);
  EXPECT_NEAR(levels, expected, 1e-9);
  EXPECT_NEAR(unobserved, expected, 1e-9);
}

}  // namespace
}  // namespace roomcut::extract

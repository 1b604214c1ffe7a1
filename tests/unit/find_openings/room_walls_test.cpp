// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/find_openings/room_walls.h"

#include <gtest/gtest.h>

#include "tests/unit/find_openings/made_wall.h"

namespace roomcut::find_openings {
namespace {

TEST(RoomWalls, OneWallBetweenTwoRoomsWithItsThicknessAndExtent) {
  for (const double angle : {0.0, 0.4, 2.0}) {
    test::MadeWall made;
    made.angle = angle;
    const CellComplex complex = made.complex();
    const auto walls = find_room_walls(complex, made.labels(complex).label, 0.6, 3, 0.05);
    ASSERT_EQ(walls.size(), 1U);
    const RoomWall& wall = walls[0];
    EXPECT_NEAR(wall.thickness(wall.t0()), 0.12, 1e-9);
    EXPECT_NEAR(static_cast<double>(wall.columns) * wall.step_m, 5.0, 0.051);
    for (std::size_t c = 0; c < wall.columns; ++c) {
      EXPECT_FALSE(wall.stands(c, 0));
      EXPECT_TRUE(wall.stands(c, 1));
      EXPECT_FALSE(wall.stands(c, 2));
    }
    const Vec2 on_a = wall.a.at(wall.t0() + 1);
    EXPECT_NEAR(wall.depth(on_a), 0, 1e-9);
    EXPECT_NEAR(wall.depth(on_a + 0.12 * wall.side * wall.a.normal()), 0.12, 1e-9);
  }
}

TEST(RoomWalls, AWallToTheOutsideOrTooThickIsNone) {
  test::MadeWall made;
  const CellComplex complex = made.complex();
  const Labels one_room = test::label_where(complex, [](const Vec2& p, double z) {
    return p.x() > 0 && p.x() < 4 && p.y() > 0 && p.y() < 5 && z > 0 && z < 2.6;
  });
  EXPECT_TRUE(find_room_walls(complex, one_room.label, 0.6, 3, 0.05).empty());
  EXPECT_TRUE(find_room_walls(complex, made.labels(complex).label, 0.1, 3, 0.05).empty());
}

TEST(RoomWalls, FacesInsideTheWallAreWalkedThrough) {
  // The wall's solid is cut by a line along it and by one across it.
  const CellComplex complex =
      test::grid_complex({-1, 0, 4, 4.05, 4.12, 8, 9}, {-1, 0, 2.3, 5, 6}, {-0.5, 0, 2.6, 3});
  const Labels labels = test::label_where(complex, [](const Vec2& p, double z) {
    return z > 0 && z < 2.6 && p.y() > 0 && p.y() < 5 &&
           ((p.x() > 0 && p.x() < 4) || (p.x() > 4.12 && p.x() < 8));
  });
  const auto walls = find_room_walls(complex, labels.label, 0.6, 3, 0.05);
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_NEAR(walls[0].thickness(walls[0].t0()), 0.12, 1e-9);
  EXPECT_EQ(walls[0].columns, 100U);
}

TEST(RoomWalls, GapsAreMarkedUpToTheirGreatestWidth) {
  const CellComplex complex =
      test::grid_complex({-1, 0, 4, 4.12, 8, 9}, {-1, 0, 2, 2.5, 5, 6}, {-0.5, 0, 2.6, 3});
  const Labels labels = test::label_where(complex, [](const Vec2& p, double z) {
    return z > 0 && z < 2.6 && p.y() > 0 && p.y() < 5 && p.x() > 0 && p.x() < 8 &&
           (p.x() < 4 || p.x() > 4.12 || (p.y() > 2 && p.y() < 2.5));
  });
  for (const double widest : {0.4, 1.0}) {
    const auto walls = find_room_walls(complex, labels.label, 0.6, widest, 0.05);
    ASSERT_EQ(walls.size(), 1U);
    std::size_t gaps = 0;
    for (std::size_t c = 0; c < walls[0].columns; ++c) {
      gaps += walls[0].is_gap(c, 1) ? 1 : 0;
    }
    EXPECT_EQ(gaps, widest < 0.5 ? 0U : 10U);
  }
}

}  // namespace
}  // namespace roomcut::find_openings

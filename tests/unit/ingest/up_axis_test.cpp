// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/up_axis.h"

#include <gtest/gtest.h>

#include "memory_scan.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

/// The question asked of a room whose corners are turned: its height lies along axis `up` of the file.
std::string question(const Room& room, int up) {
  std::vector<Vec3> points = room.points();
  for (Vec3& point : points) {
    std::swap(point[2], point[up]);
  }
  Vec3 low = points.front();
  Vec3 high = points.front();
  for (const Vec3& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  AxisAreas areas;
  for (const CloudTile& tile : make_cloud(MemoryScan(points)).tiles) {
    areas.add(tile);
  }
  return upright_floors(areas, low, high, "z");
}

TEST(UpAxis, is_questioned_where_floors_stand_upright) {
  for (const int up : {0, 1}) {
    Room room;
    room.density = 200;
    room.size = Vec3(12, 9, 2.7);
    const std::string text = question(room, up);
    EXPECT_NE(text.find(std::string("--up ") + "xy"[up]), std::string::npos) << text;
  }
}

TEST(UpAxis, is_not_questioned_where_floors_are_level) {
  Room room;
  room.density = 200;
  EXPECT_EQ(question(room, 2), "");
  room.size = Vec3(40, 2.2, 2.6);
  EXPECT_EQ(question(room, 2), "") << "a corridor has more wall than floor";
  room.size = Vec3(6, 5, 9);
  EXPECT_EQ(question(room, 2), "") << "a tower";
}

}  // namespace
}  // namespace roomcut::testing

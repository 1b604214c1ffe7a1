// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/mesh/mesh_check.h"
#include "stages/tools/synthesize/elements.h"
#include "stages/tools/synthesize/truth.h"
#include "stages/tools/synthesize/walls.h"

namespace roomcut::synthesize {
namespace {

class Families : public testing::TestWithParam<std::string> {};

TEST_P(Families, MakeValidBuildingsWhoseRoomsAreAllReachable) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene;
    scene.name = GetParam();
    FamilySpec spec;
    spec.family = GetParam();
    spec.seed = seed;
    add_random_building(spec, scene);
    ASSERT_GE(scene.rooms.size(), 3U);
    Building building;
    ASSERT_NO_THROW(building = place(scene));
    TriangleMesh mesh;
    ASSERT_NO_THROW(mesh = make_truth(scene, building));
    const MeshCheck check = check_mesh(mesh);
    EXPECT_TRUE(check.valid()) << describe_faults(check);
    const auto storeys = static_cast<std::int64_t>(scene.storeys.size());
    EXPECT_LE(check.components, storeys);  // doors join all rooms of a storey, shafts the storeys
    if (seed == 1) {
      Scene again;
      add_random_building(spec, again);
      ASSERT_EQ(again.rooms.size(), scene.rooms.size());
      EXPECT_EQ(again.rooms.back().polygon, scene.rooms.back().polygon);
    }
  }
}

TEST_P(Families, WithoutDoorsEveryRoomStandsAlone) {
  Scene scene;
  FamilySpec spec;
  spec.family = GetParam();
  spec.doors = false;
  spec.shafts = false;
  add_random_building(spec, scene);
  const MeshCheck check = check_mesh(make_truth(scene, place(scene)));
  EXPECT_TRUE(check.valid());
  EXPECT_EQ(check.components, static_cast<std::int64_t>(scene.rooms.size()));
}

TEST_P(Families, RoomsThatNoScannerEntersHaveADoorToOneThatIsEntered) {
  Scene scene;
  FamilySpec spec;
  spec.family = GetParam();
  spec.unscanned = 0.25;
  add_random_building(spec, scene);
  std::size_t closed = 0;
  for (std::size_t room = 0; room < scene.rooms.size(); ++room) {
    if (scene.rooms[room].scanned) continue;
    ++closed;
    const auto looks_in = [&](const SceneDoor& door) {
      return (door.room_a == static_cast<int>(room) && scene.rooms[door.room_b].scanned) ||
             (door.room_b == static_cast<int>(room) && scene.rooms[door.room_a].scanned);
    };
    EXPECT_TRUE(std::any_of(scene.doors.begin(), scene.doors.end(), looks_in)) << scene.rooms[room].name;
  }
  EXPECT_EQ(closed, static_cast<std::size_t>(std::lround(0.25 * static_cast<double>(scene.rooms.size()))));
}

TEST_P(Families, WithAllElementsAreStillValidBuildings) {
  for (std::uint64_t seed = 11; seed <= 14; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene;
    FamilySpec spec;
    spec.family = GetParam();
    spec.seed = seed;
    spec.elements = element_names();
    add_random_building(spec, scene);
    TriangleMesh mesh;
    ASSERT_NO_THROW(mesh = make_truth(scene, place(scene)));
    const MeshCheck check = check_mesh(mesh);
    EXPECT_TRUE(check.valid()) << describe_faults(check);
    std::size_t slopes = 0;
    for (const SceneRoom& room : scene.rooms) slopes += room.slopes.size();
    EXPECT_GT(slopes, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Families, testing::ValuesIn(family_names()),
                         [](const auto& family) { return family.param; });

TEST(FamilyThin, HasThinWalls) {
  Scene scene;
  FamilySpec spec;
  spec.family = "thin";
  add_random_building(spec, scene);
  const auto walls = find_walls(scene);
  ASSERT_GT(walls.size(), 4U);
  for (const Wall& wall : walls) {
    EXPECT_GE(wall.thickness, 0.06 - 1e-9);
    EXPECT_LE(wall.thickness, 0.10 + 1e-9);
  }
}

}  // namespace
}  // namespace roomcut::synthesize

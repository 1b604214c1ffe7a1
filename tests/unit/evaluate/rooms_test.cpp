// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "stages/tools/evaluate/evaluate.h"
#include "tests/unit/mesh/shapes.h"

namespace roomcut::evaluate {
namespace {

using test::append;
using test::box;

const EvaluateParams kCoarse = [] {  // quick
  EvaluateParams params;
  params.sample_spacing_m = 0.05;
  params.column_spacing_m = 0.02;
  return params;
}();

// Three rooms in a row, 4 m x 3 m x 2.5 m, with walls of 0.1 m; and one above the first, the slab 0.3 m.
TriangleMesh truth() {
  TriangleMesh mesh = box({0, 0, 0}, {4, 3, 2.5});
  append(mesh, box({4.1, 0, 0}, {8.1, 3, 2.5}));
  append(mesh, box({8.2, 0, 0}, {12.2, 3, 2.5}));
  append(mesh, box({0, 0, 2.8}, {4, 3, 5.3}));
  return mesh;
}

TEST(Rooms, WithoutADescriptionEveryBodyIsARoom) {
  const TriangleMesh mesh = truth();
  const Columns columns(mesh);
  const auto rooms = locate_rooms({}, columns);
  ASSERT_EQ(rooms.size(), 4U);
  EXPECT_EQ(rooms[3].body, 3);
}

TEST(Rooms, RoomsInOneBodyBecomeOneAndKeepTheirNames) {
  const TriangleMesh mesh = truth();
  const Columns columns(mesh);
  DescribedRoom kitchen{"kitchen", {}, 0, 2.5, {1, 1, 1}};
  DescribedRoom bar{"bar", {}, 0, 2.5, {3, 1, 1}};
  const auto rooms = locate_rooms({kitchen, bar}, columns);
  ASSERT_EQ(rooms.size(), 4U);
  EXPECT_EQ(rooms[0].name, "kitchen + bar");
}

TEST(Rooms, AMissingRoomIsMissedAndLowersTheRecall) {
  TriangleMesh model = box({0, 0, 0}, {4, 3, 2.5});
  append(model, box({4.1, 0, 0}, {8.1, 3, 2.5}));
  append(model, box({0, 0, 2.8}, {4, 3, 5.3}));
  const Scores scores = evaluate(model, truth(), {}, kCoarse);
  EXPECT_EQ(scores.found(), 3U);
  EXPECT_FALSE(scores.rooms[2].found());
  EXPECT_TRUE(scores.merged.empty());
  EXPECT_NEAR(scores.volume->recall(), 0.75, 5e-3);
  EXPECT_NEAR(scores.volume->precision(), 1, 1e-12);
  EXPECT_NEAR(scores.volume->iou(), 0.75, 5e-3);
}

TEST(Rooms, AMissingWallMergesItsTwoRooms) {
  TriangleMesh model = box({0, 0, 0}, {8.1, 3, 2.5});
  append(model, box({8.2, 0, 0}, {12.2, 3, 2.5}));
  append(model, box({0, 0, 2.8}, {4, 3, 5.3}));
  const Scores scores = evaluate(model, truth(), {}, kCoarse);
  EXPECT_EQ(scores.found(), 4U);
  ASSERT_EQ(scores.merged.size(), 1U);
  EXPECT_EQ(scores.merged[0], (std::vector<std::int32_t>{0, 1}));
  EXPECT_NEAR(scores.thin.wall_m2, 4 * 7.5, 0.05);
  EXPECT_NEAR(scores.thin.wall_kept_m2, 2 * 7.5, 0.05);
  EXPECT_NEAR(scores.thin.slab_kept_m2 / scores.thin.slab_m2, 1, 1e-12);
}

TEST(Rooms, AMissingSlabMergesTheRoomsAboveEachOther) {
  TriangleMesh model = box({0, 0, 0}, {4, 3, 5.3});
  append(model, box({4.1, 0, 0}, {8.1, 3, 2.5}));
  append(model, box({8.2, 0, 0}, {12.2, 3, 2.5}));
  const Scores scores = evaluate(model, truth(), {}, kCoarse);
  ASSERT_EQ(scores.merged.size(), 1U);
  EXPECT_EQ(scores.merged[0], (std::vector<std::int32_t>{0, 3}));
  EXPECT_EQ(scores.in_merged_groups(), 2U);
}

TEST(Rooms, ADoorwayDoesNotMergeRooms) {
  // An opening of 1 m x 2 m in the wall between the first two rooms: the mesh overlaps itself, the union
  // counts.
  TriangleMesh model = truth();
  append(model, box({3.9, 1, 0.001}, {4.2, 2, 2}));
  const Scores scores = evaluate(model, truth(), {}, kCoarse);
  EXPECT_TRUE(scores.merged.empty());
  EXPECT_NEAR(scores.thin.wall_kept_m2 / scores.thin.wall_m2, 1 - 2.0 / 15, 2e-3);
}

TEST(Rooms, PrismsDescribeRoomsThatDoorwaysJoinToOneBody) {
  TriangleMesh joined = box({0, 0, 0}, {8, 3, 2.5});  // one body, described as two rooms
  const auto square = [](double x0, double x1) {
    return std::vector<Vec2>{{x0, 0}, {x1, 0}, {x1, 3}, {x0, 3}};
  };
  const std::vector<DescribedRoom> described = {{"west", square(0, 4), 0, 2.5, {0, 0, 0}},
                                                {"east", square(4, 8), 0, 2.5, {0, 0, 0}}};
  const Scores scores = evaluate(box({0, 0, 0}, {4, 3, 2.5}), joined, {described, {}}, kCoarse);
  ASSERT_EQ(scores.rooms.size(), 2U);
  EXPECT_TRUE(scores.rooms[0].found());
  EXPECT_FALSE(scores.rooms[1].found());
  EXPECT_NEAR(scores.rooms[0].volume_m3, 30, 0.2);
  EXPECT_NEAR(scores.rooms[1].empty_m3, 0, 0.2);
}

/// Points every 4 cm on both faces of the wall of truth() between x = 4 and 4.1, from y = 0 to `until`.
ScannedSurface wall_scanned(double until) {
  ScannedSurface scanned(600);
  for (double y = 0; y < until; y += 0.04) {
    for (double z = 0; z < 2.5; z += 0.04) {
      scanned.add({4, y, z});
      scanned.add({4.1, y, z});
    }
  }
  return scanned;
}

TEST(ScannedSurface, SurroundsWhatLiesInItAndNothingInAnOpening) {
  const ScannedSurface scanned = wall_scanned(1.2);
  const Vec3 normal(1, 0, 0);
  EXPECT_TRUE(scanned.surrounds({4, 0.6, 1}, normal));
  EXPECT_TRUE(scanned.surrounds({4.02, 0.6, 1}, -normal));
  EXPECT_FALSE(scanned.surrounds({4, 1.25, 1}, normal)) << "beside the jamb";
  EXPECT_FALSE(scanned.surrounds({4, 2, 1}, normal));
  EXPECT_FALSE(scanned.surrounds({4.5, 0.6, 1}, normal)) << "off the plane";
  EXPECT_FALSE(scanned.surrounds({4, 0.6, 1}, Vec3(0, 1, 0))) << "across the wall";
}

// Rooms joined over most of their wall, in the model; what the scan shows of it decides.
TEST(Rooms, ADoorUpToTheCeilingMergesNoRoomsAndTheLostWallBesideItDoes) {
  TriangleMesh truth = box({0, 0, 0}, {4, 3, 2.5});
  append(truth, box({4.1, 0, 0}, {8, 3, 2.5}));
  TriangleMesh door = truth;
  append(door, box({3.9, 1.2, 0.001}, {4.2, 2.999, 2.499}));
  const ScannedSurface beside = wall_scanned(1.2);
  const ScannedSurface everywhere = wall_scanned(3);
  const auto merged = [&](const TruthDescription& described, const ScannedSurface* scanned) {
    return evaluate(door, truth, described, kCoarse, nullptr, scanned).merged.size();
  };
  EXPECT_EQ(merged({}, nullptr), 1U);
  EXPECT_EQ(merged({}, &beside), 0U);
  EXPECT_EQ(merged({}, &everywhere), 1U) << "there is a wall";
  const TruthDescription nobody = {{{"a", {}, 0, 2.5, {1, 1, 1}, false}, {"b", {}, 0, 2.5, {5, 1, 1}, false}},
                                   {}};
  EXPECT_EQ(merged(nobody, &beside), 1U) << "that nobody saw it does not mean that there is a door";
}

}  // namespace
}  // namespace roomcut::evaluate

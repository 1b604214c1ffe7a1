// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/errors/error.h"
#include "common/mesh/mesh_check.h"
#include "stages/tools/synthesize/families.h"
#include "stages/tools/synthesize/room_heights.h"
#include "stages/tools/synthesize/synthesize_io.h"
#include "tests/unit/synthesize/test_scenes.h"

namespace roomcut::synthesize {
using namespace roomcut::test;

namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;

/// A room of 8 x 6 m with `more` members.
Scene hall(const char* more, double ceiling = 10) {
  json room = {{"name", "a"}, {"polygon", json::parse("[[0,0],[8,0],[8,6],[0,6]]")}};
  room.update(json::parse(more));
  return scene_from_json({{"storeys", {{{"floor", 0}, {"ceiling", ceiling}, {"rooms", {room}}}}}}, "s");
}

/// The volume of a truth that is a valid mesh; -1 of another.
double valid_volume(const Scene& scene) {
  const MeshCheck check = check_mesh(make_truth(scene, place(scene)));
  EXPECT_TRUE(check.valid()) << describe_faults(check);
  return check.valid() ? check.volume_m3 : -1;
}

TEST(Elements, RoofsHaveTheVolumeOfTheirGeometry) {
  const double rise = 3 * std::tan(40 * kPi / 180);  // over half the depth of 6 m
  EXPECT_NEAR(
      valid_volume(hall(R"({"roof": {"kind": "gable", "pitch_deg": 40, "azimuth_deg": 90, "eaves": 0.8}})")),
      48 * 0.8 + 8 * 6 * rise / 2, 1e-4);
  EXPECT_NEAR(
      valid_volume(hall(R"({"roof": {"kind": "hip", "pitch_deg": 40, "azimuth_deg": 90, "eaves": 0}})")),
      2 * 6 * rise / 2 + 6 * 6 * rise / 3, 1e-4);
  EXPECT_NEAR(valid_volume(
                  hall(R"({"roof": {"kind": "monopitch", "pitch_deg": 40, "azimuth_deg": 90, "eaves": 2}})")),
              48 * 2 + 48 * rise, 1e-4);
}

TEST(Elements, ACollarCutsTheRidgeAndARoofAboveItDoesNothing) {
  const double rise = 3 * std::tan(45 * kPi / 180);
  const char* gable = R"({"roof": {"kind": "gable", "pitch_deg": 45, "azimuth_deg": 90, "eaves": 1}})";
  EXPECT_NEAR(valid_volume(hall(gable, 3)), 48 + 8 * 6 * rise / 2 - 8 * 1 * 1, 1e-4);
  EXPECT_NEAR(valid_volume(hall(gable, 1)), 48, 1e-4);
}

TEST(Elements, ARoofThatComesDownInsideTheRoomEndsIt) {
  // From 2 m up at y = 0 to the floor at y = 4.
  const Scene scene =
      hall(R"({"slopes": [{"at": [0, 4], "z": 0, "pitch_deg": 26.565051177, "azimuth_deg": 90}]})");
  EXPECT_NEAR(valid_volume(scene), 8 * 4 * 2 / 2.0, 1e-4);
  EXPECT_FALSE(scene.rooms[0].level_ceiling);
}

TEST(Elements, ARampWithItsPlatformHasTheVolumeOfItsGeometry) {
  const Scene scene = hall(R"({"slopes": [
    {"of": "floor", "at": [2, 0], "z": 0, "pitch_deg": 5.710593137, "azimuth_deg": 180, "polygon": [[2,0],[6,0],[6,2],[2,2]]},
    {"of": "floor", "at": [6, 0], "z": 0.4, "polygon": [[6,0],[8,0],[8,6],[6,6]]}]})",
                           3);
  EXPECT_NEAR(valid_volume(scene), 48 * 3 - 2 * 4 * 0.4 / 2 - 2 * 6 * 0.4, 1e-5);
  EXPECT_NEAR(floor_at(scene.rooms[0], {4, 1}), 0.2, 1e-9);
  EXPECT_NEAR(floor_at(scene.rooms[0], {4, 3}), 0, 1e-9);
  EXPECT_NEAR(floor_at(scene.rooms[0], {7, 3}), 0.4, 1e-9);
}

TEST(Elements, AFloorThatSlopesEverywhereIsNowhereLevel) {
  const Scene scene =
      hall(R"({"slopes": [{"of": "floor", "at": [0, 0], "z": 0, "pitch_deg": 2, "azimuth_deg": 180}]})", 3);
  EXPECT_FALSE(scene.rooms[0].level_floor);
  EXPECT_TRUE(scene.rooms[0].level_ceiling);
  EXPECT_NEAR(valid_volume(scene), 48 * 3 - 48 * 4 * std::tan(2 * kPi / 180), 1e-4);
}

TEST(Elements, ColumnsNichesAndPilastersAreOfTheirSize) {
  EXPECT_NEAR(valid_volume(hall(R"({"columns": [{"at": [2, 2], "width": 0.4, "shape": "round"}]})", 3)),
              3 * (48 - kPi * 0.04), 1e-9);
  EXPECT_NEAR(valid_volume(hall(
                  R"({"columns": [{"at": [2, 2], "width": 0.4, "depth": 0.3, "rotation_deg": 20}]})", 3)),
              3 * (48 - 0.12), 1e-9);
  EXPECT_NEAR(valid_volume(hall(R"({"niches": [{"at": [2, 0], "width": 0.5, "depth": 0.2}]})", 3)),
              3 * (48 + 0.1), 1e-9);
  EXPECT_NEAR(
      valid_volume(
          hall(R"({"niches": [{"at": [2, 0], "width": 0.5, "depth": 0.2, "sill": 1, "height": 1.5}]})", 3)),
      3 * 48 + 0.15, 1e-9);
  EXPECT_NEAR(valid_volume(hall(R"({"niches": [{"at": [2, 0], "width": 0.5, "depth": -0.2}]})", 3)),
              3 * (48 - 0.1), 1e-9);
}

TEST(Elements, ACeilingMayBeLowerInAPartOfTheRoom) {
  EXPECT_NEAR(valid_volume(hall(
                  R"({"slopes": [{"at": [3, 0], "z": 2.6, "polygon": [[3,0],[3.3,0],[3.3,6],[3,6]]}]})", 3)),
              48 * 3 - 0.3 * 6 * 0.4, 1e-9);
}

TEST(Elements, PointsLieOnSlopesAndStationsBelowThem) {
  Scene scene = hall(R"({"roof": {"kind": "gable", "pitch_deg": 40, "azimuth_deg": 90, "eaves": 0.8}})");
  scene.noise_m = 0;
  for (const SamplingKind kind : {SamplingKind::kUniform, SamplingKind::kTripod}) {
    scene.sampling.kind = kind;
    scene.sampling.points = 20000;
    const std::vector<float> xyz = all_points(scene);
    std::size_t on_roof = 0;
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
      const double below = ceiling_at(scene.rooms[0], {xyz[i], xyz[i + 1]}) - xyz[i + 2];
      ASSERT_GT(below, -1e-3);
      on_roof += below < 1e-3 ? 1 : 0;
    }
    EXPECT_GT(on_roof, xyz.size() / 3 / 5);
  }
  for (const Vec3& station : place(scene).stations) {
    EXPECT_LT(station.z(), ceiling_at(scene.rooms[0], station.head<2>()) - 0.2);
  }
}

TEST(Elements, WhatDoesNotFitUnderASlopeIsRefused) {
  const auto complaint = [](const char* room, const char* door) {
    json scene = test::two_rooms_json();
    scene["storeys"][0]["rooms"][0].update(json::parse(room));
    scene["doors"][0].update(json::parse(door));
    try {
      valid_volume(scene_from_json(scene, "s"));
    } catch (const StageError& error) {
      return error.problems().front().what;
    }
    return std::string();
  };
  const char* low =
      R"({"ceiling": 9, "roof": {"kind": "monopitch", "pitch_deg": 30, "azimuth_deg": 0, "eaves": 1.5}})";
  EXPECT_NE(complaint(low, R"({"height": 2.0})").find("ceiling"), std::string::npos);
  EXPECT_EQ(complaint(low, R"({"height": 1.3})"), "");
  EXPECT_NE(complaint(R"({"niches": [{"at": [2, 0], "depth": 0.001}]})", "{}").find("1 cm"),
            std::string::npos);
  EXPECT_NE(complaint(R"({"columns": [{"at": [9, 9], "width": 0.3}]})", "{}").find("outside"),
            std::string::npos);
}

/// Of one room with `outline` (middle lines of walls of 20 cm) or `polygon`.
std::vector<SceneArc> arcs(const char* key, const char* corners) {
  json room = {{"name", "a"}, {"wall", 0.2}, {key, json::parse(corners)}};
  if (std::string(key) == "polygon") room.erase("wall");
  return scene_from_json({{"storeys", {{{"floor", 0}, {"ceiling", 3}, {"rooms", {room}}}}}}, "s")
      .rooms[0]
      .arcs;
}

TEST(Elements, ArcsOfAPolygonAreKnownByCentreAndRadius) {
  const auto bay =
      arcs("polygon", R"([[0,0],{"arc":{"through":[2,-2],"to":[4,0],"segments":0}},[4,3],[0,3]])");
  ASSERT_EQ(bay.size(), 1U);
  EXPECT_NEAR((bay[0].centre - Vec2(2, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR(bay[0].radius, 2, 1e-9);
  EXPECT_TRUE(bay[0].bulges);
  EXPECT_NEAR((bay[0].from - Vec2(0, 0)).norm() + (bay[0].to - Vec2(4, 0)).norm(), 0, 1e-9);
  const auto dent =
      arcs("polygon", R"([[0,0],{"arc":{"through":[2,1],"to":[4,0],"segments":12}},[4,3],[0,3]])");
  ASSERT_EQ(dent.size(), 1U);
  EXPECT_NEAR(dent[0].radius, 2.5, 1e-9);
  EXPECT_FALSE(dent[0].bulges);
  EXPECT_NEAR((dent[0].from - Vec2(4, 0)).norm(), 0, 1e-9);
  EXPECT_TRUE(arcs("polygon", "[[0,0],[4,0],[4,3],[0,3]]").empty());
}

TEST(Elements, TwoHalvesOfACircleAreOneArcWhateverTheDirection) {
  for (
      const char* corners :
      {R"([[2,0],{"arc":{"through":[0,2],"to":[-2,0],"segments":20}},{"arc":{"through":[0,-2],"to":[2,0],"segments":20}}])",
       R"([[2,0],{"arc":{"through":[0,-2],"to":[-2,0],"segments":20}},{"arc":{"through":[0,2],"to":[2,0],"segments":20}}])"}) {
    const auto circle = arcs("polygon", corners);
    ASSERT_EQ(circle.size(), 1U);
    EXPECT_NEAR(circle[0].radius, 2, 1e-9);
    EXPECT_NEAR((circle[0].from - circle[0].to).norm(), 0, 1e-9);
  }
}

TEST(Elements, AWallAlongAnArcLeavesAConcentricRoom) {
  const auto inner =
      arcs("outline", R"([[2,0],{"arc":{"through":[0,2],"to":[-2,0],"segments":0}},[-2,-2],[2,-2]])");
  ASSERT_EQ(inner.size(), 1U);
  EXPECT_NEAR(inner[0].centre.norm(), 0, 1e-6);
  EXPECT_NEAR(inner[0].radius, 1.9, 2e-4);  // the chords' distance is exact, their corners' by the sagitta
}

TEST(Elements, RandomArcsLieOnTheirCirclesAndAreSmooth) {
  std::size_t bulging = 0;
  std::size_t hollow = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene scene;
    FamilySpec spec;
    spec.seed = seed;
    spec.elements = {"arcs"};
    add_random_building(spec, scene);
    for (const SceneRoom& room : scene.rooms) {
      for (const SceneArc& arc : room.arcs) {
        (arc.bulges ? bulging : hollow) += 1;
        EXPECT_NEAR((arc.from - arc.centre).norm(), arc.radius, 1e-6);
        EXPECT_NEAR((arc.to - arc.centre).norm(), arc.radius, 1e-6);
        std::size_t on = 0;
        for (std::size_t i = 0; i < room.polygon.size(); ++i) {
          const Vec2 middle = 0.5 * (room.polygon[i] + room.polygon[(i + 1) % room.polygon.size()]);
          on += std::abs((middle - arc.centre).norm() - arc.radius) < 3e-4 ? 1 : 0;
        }
        EXPECT_GT(on, 10U) << room.name;
      }
    }
  }
  EXPECT_GT(bulging, 20U);
  EXPECT_GT(hollow, 3U);
}

TEST(Elements, TheTruthNamesColumnsNichesAndArcsOfEveryCopy) {
  Scene scene = hall(R"({"columns": [{"at": [2, 2], "width": 0.4, "shape": "round"}],
    "niches": [{"at": [2, 0], "width": 0.5, "depth": 0.2}, {"at": [6, 0], "width": 0.6, "depth": -0.1}]})",
                     3);
  scene.rooms[0].arcs.push_back({{1, 2}, 3, {4, 2}, {1, 5}, true});
  scene.repeat.x = 2;
  const Building building = place(scene);
  const json truth = truth_json(scene, building, make_truth(scene, building), 0);
  ASSERT_EQ(truth["columns"].size(), 2U);
  EXPECT_EQ(truth["columns"][0]["shape"], "round");
  EXPECT_NEAR(truth["columns"][1]["center"][0].get<double>() - 2, 8.4, 1e-6);  // the gap is 40 cm
  EXPECT_EQ(truth["columns"][1]["room"], 1);
  ASSERT_EQ(truth["niches"].size(), 4U);
  EXPECT_FALSE(truth["niches"][0]["pilaster"].get<bool>());
  EXPECT_TRUE(truth["niches"][1]["pilaster"].get<bool>());
  EXPECT_NEAR(truth["niches"][1]["depth"].get<double>(), 0.1, 1e-9);
  ASSERT_EQ(truth["arcs"].size(), 2U);
  EXPECT_NEAR(truth["arcs"][0]["radius"].get<double>(), 3, 1e-9);
  EXPECT_NEAR(truth["rooms"][0]["volume"].get<double>(), 3 * (48 - kPi * 0.04 - 0.06), 1e-5);
}

TEST(Elements, HeightsDifferByWholeCentimetres) {
  Scene plain;
  Scene off;
  FamilySpec spec;
  add_random_building(spec, plain);
  spec.elements = {"heights"};
  add_random_building(spec, off);
  ASSERT_EQ(off.rooms.size(), plain.rooms.size());
  bool differs = false;
  for (std::size_t i = 0; i < off.rooms.size(); ++i) {
    const double cm = 100 * (off.rooms[i].floor - plain.rooms[i].floor);
    EXPECT_NEAR(cm, std::round(cm), 1e-6);
    EXPECT_LE(std::abs(cm), 3.001);
    differs = differs || cm > 0.5;
  }
  EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace roomcut::synthesize

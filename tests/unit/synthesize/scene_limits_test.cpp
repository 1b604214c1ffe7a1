// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that ask for too much are refused at once, each with a remedy.
#include "stages/tools/synthesize/scene_limits.h"

#include <gtest/gtest.h>

#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "stages/tools/synthesize/sample.h"
#include "stages/tools/synthesize/scene_json.h"
#include "stages/tools/synthesize/truth.h"

namespace roomcut::synthesize {
namespace {

using nlohmann::json;

json one_room(double x, double y) {
  json room{{"name", "hall"}, {"polygon", {{0, 0}, {x, 0}, {x, y}, {0, y}}}};
  json storey{{"floor", 0}, {"ceiling", 3}};
  storey["rooms"].push_back(room);
  json scene{{"name", "test"}};
  scene["storeys"].push_back(storey);
  return scene;
}

/// The problems that stop the scene before a point is made.
std::vector<Problem> problems(const json& root) {
  try {
    const Scene scene = scene_from_json(root, "scene.json");
    check_limits(scene);
    const Building building = place(scene);
    const TriangleMesh truth = make_truth(scene, building);
    const Surfaces surfaces(scene, building, truth);
    make_source(scene, building, surfaces);
  } catch (const StageError& error) {
    for (const Problem& problem : error.problems()) {
      EXPECT_STREQ(problem.code.id, errors::kSceneInvalid.id);
      EXPECT_LT(problem.what.size(), 300U);
    }
    return error.problems();
  }
  return {};
}

void expect_refused(const json& root, const char* word) {
  const auto found = problems(root);
  ASSERT_FALSE(found.empty()) << word;
  EXPECT_NE(to_string(found.front()).find(word), std::string::npos) << to_string(found.front());
}

TEST(SceneLimits, ABuildingOfTodayIsFarBelowThem) {
  json scene = one_room(60, 40);
  scene["holes"] = 0.3;
  scene["clutter_per_m2"] = 0.05;
  scene["repeat"] = {{"x", 100}, {"y", 100}};
  EXPECT_TRUE(problems(scene).empty());
}

TEST(SceneLimits, RoomsOfKilometresClutterAndCopiesWithoutEnd) {
  expect_refused(one_room(100000, 100000), "m^2 of the box around it");
  json scene = one_room(100, 100);
  scene["clutter_per_m2"] = 5;
  expect_refused(scene, "boxes of furniture");
  scene = one_room(10, 10);
  scene["repeat"] = {{"x", 1000}, {"y", 1000}, {"storeys", 1000}};
  expect_refused(scene, "all copies");
  scene = one_room(140, 140);
  scene["storeys"][0]["rooms"][0]["ceiling"] = 10000;
  scene["holes"] = 0.8;
  expect_refused(scene, "holes");
}

TEST(SceneLimits, ThousandsOfCornersAndHeights) {
  json scene = one_room(10, 10);
  json& polygon = scene["storeys"][0]["rooms"][0]["polygon"];
  for (int i = 0; i < 3; ++i) {
    polygon.push_back({{"arc", {{"through", {-5 - i, 5}}, {"to", {0, 4 - i}}, {"segments", 1000}}}});
  }
  expect_refused(scene, "corners");
  scene = one_room(1, 1);
  json& rooms = scene["storeys"][0]["rooms"];
  for (int i = 1; i < 4000; ++i) {
    const double x = 2.0 * i;
    rooms.push_back({{"name", "r" + std::to_string(i)},
                     {"ceiling", 3 + 0.001 * i},
                     {"floor", 0.0001 * i},
                     {"polygon", {{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}}});
  }
  expect_refused(scene, "different heights");
  for (int i = 4000; i < 10001; ++i) {
    rooms.push_back(rooms.back());
    rooms.back()["name"] = "r" + std::to_string(i);
  }
  expect_refused(scene, "rooms: 10001");
}

TEST(SceneLimits, SlopesAndColumnsWithoutEnd) {
  json scene = one_room(20, 20);
  json& room = scene["storeys"][0]["rooms"][0];
  for (int i = 0; i < 40; ++i) room["slopes"].push_back({{"at", {0, 0}}, {"z", 2.9}, {"pitch_deg", i}});
  expect_refused(scene, "slopes");
  room["slopes"].clear();
  for (int i = 0; i < 10001; ++i) room["columns"].push_back({{"at", {1, 1}}, {"width", 0.2}});
  expect_refused(scene, "columns");
}

TEST(SceneLimits, PlansThatCrossWithoutEndAreRefusedBeforeTheyAreCut) {
  json scene = one_room(100, 100);
  json& rooms = scene["storeys"][0]["rooms"];
  for (const bool upright : {false, true}) {  // two combs, tooth across tooth
    json polygon = json::array();
    for (int i = 0; i < 450; ++i) {
      const double a = 0.2 * i;
      for (const auto& [u, v] :
           {std::pair(a, 0.1), std::pair(a, 90.0), std::pair(a + 0.1, 90.0), std::pair(a + 0.1, 0.1)}) {
        polygon.push_back(upright ? json{v, u} : json{u, v});
      }
    }
    polygon.push_back(upright ? json{0, 89.9} : json{89.9, 0});
    polygon.push_back({0, 0});
    rooms.push_back({{"name", upright ? "b" : "a"}, {"polygon", polygon}});
  }
  expect_refused(scene, "cross each other too often");
}

TEST(SceneLimits, NamesAreOfOneShortLine) {
  json scene = one_room(10, 10);
  scene["name"] = "a\nelement vertex 5";  // would stand in the scan's header
  expect_refused(scene, "one line");
  scene["name"] = std::string(100000, 'x');
  expect_refused(scene, "one line");
  scene["name"] = "Büro";
  scene[std::string(100000, 'k')] = 1;
  expect_refused(scene, "unknown key");
}

TEST(SceneLimits, OfManyProblemsTheFirstAreListedAndTheOthersCounted) {
  json scene = one_room(10, 10);
  for (int i = 0; i < 3000; ++i) scene["doors"].push_back({{"between", {"hall", "none"}}, {"at", {1, 1}}});
  const auto found = problems(scene);
  ASSERT_EQ(found.size(), scene_limits::kProblems + 1);
  EXPECT_NE(found.back().what.find("more problems"), std::string::npos);
}

TEST(SceneLimits, ScannersThatSeeHardlyAnythingAreRefused) {
  json scene = one_room(10, 10);
  scene["sampling"] = {{"kind", "tripod"}, {"stations", {{5, 5, 1000}}}};
  expect_refused(scene, "beam");
}

}  // namespace
}  // namespace roomcut::synthesize

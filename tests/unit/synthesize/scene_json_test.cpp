// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/scene_json.h"

#include <gtest/gtest.h>

#include <string>

#include "common/errors/codes.h"
#include "stages/tools/synthesize/plan.h"
#include "tests/unit/synthesize/test_scenes.h"

namespace roomcut::synthesize {
using namespace roomcut::test;

namespace {

using nlohmann::json;

/// What scene_from_json() and place() complain of, one line per problem.
std::string complaints(const json& scene) {
  try {
    place(scene_from_json(scene, "s"));
  } catch (const StageError& error) {
    std::string text;
    for (const Problem& problem : error.problems()) {
      EXPECT_STREQ(problem.code.id, errors::kSceneInvalid.id);
      EXPECT_FALSE(problem.hint.empty()) << problem.what;
      text += problem.where + " " + problem.what + "\n";
    }
    return text;
  }
  return "";
}

TEST(SceneJson, ClockwisePolygonsAreTurnedAround) {
  const Scene scene = test::box_scene(json::parse(
      R"({"storeys": [{"floor": 0, "ceiling": 2, "rooms": [{"polygon": [[0,0],[0,1],[1,1],[1,0],[0,0]]}]}]})"));
  ASSERT_EQ(scene.rooms[0].polygon.size(), 4U);
  EXPECT_GT(doubled_area(scene.rooms[0].polygon), 0);
}

TEST(SceneJson, WallThicknessPerSideFollowsTheListedSidesAlsoClockwiseAndBesideArcs) {
  for (const char* outline : {R"([[0,0],[4,0],[4,3],[0,3]])", R"([[0,3],[4,3],[4,0],[0,0]])"}) {
    json room = {{"outline", json::parse(outline)}, {"wall", json::parse("[0.2, 0.4, 0.2, 0.6]")}};
    json scene = {{"storeys", {{{"floor", 0}, {"ceiling", 2}, {"rooms", {room}}}}}};
    const Scene read = scene_from_json(scene, "s");
    double lo = 1e9;
    double hi = -1e9;
    for (const Vec2& p : read.rooms[0].polygon) {
      lo = std::min(lo, p.x());
      hi = std::max(hi, p.x());
    }
    EXPECT_NEAR(lo, 0.3, 1e-12);
    EXPECT_NEAR(hi, 3.8, 1e-12);
  }
  const Scene arc = scene_from_json(
      json::parse(R"({"storeys": [{"floor": 0, "ceiling": 2, "rooms": [{"wall": [0.2, 0.4, 0.2],
        "outline": [[0,0],[4,0],{"arc": {"through": [2,2],"to": [0,0.5],"segments": 7}}]}]}]})"),
      "s");
  EXPECT_EQ(arc.rooms[0].polygon.size(), 9U);
  EXPECT_NEAR(arc.rooms[0].polygon[0].y(), 0.1, 1e-12);
}

TEST(SceneJson, AllProblemsAreListedAtOnceWithTheirPlace) {
  const std::string text = complaints(json::parse(R"({
    "nois_m": 0.1, "holes": 2,
    "storeys": [{"floor": 0, "rooms": [{"name": "a", "polygon": [[0,0],[1,0]]},
                                       {"name": "a", "polygon": [[0,0],[1,0],[1,1]], "ceiling": 0}]}],
    "doors": [{"between": ["a", "z"], "at": [0, 0]}]})"));
  EXPECT_NE(text.find("s: scene unknown key \"nois_m\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"holes\" must be a number in"), std::string::npos) << text;
  EXPECT_NE(text.find("storeys[0] \"ceiling\" is missing"), std::string::npos) << text;
  EXPECT_NE(text.find("rooms[0] \"polygon\": a polygon needs three corners"), std::string::npos) << text;
  EXPECT_NE(text.find("rooms[1] a second room named"), std::string::npos) << text;
  EXPECT_NE(text.find("doors[0] there is no room named \"z\""), std::string::npos) << text;
}

TEST(SceneJson, AMissingFileAndTextThatIsNoJsonAreUnreadable) {
  try {
    read_scene("no/such/scene.json");
    FAIL();
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems().front().code.id, errors::kSceneUnreadable.id);
  }
  EXPECT_THROW(read_scene(ROOMCUT_SOURCE_DIR "/CMakeLists.txt"), StageError);
}

TEST(SceneJson, DoorsThatDoNotFitAreRefused) {
  json wide = test::two_rooms_json();
  wide["doors"][0]["width"] = 3.1;
  EXPECT_NE(complaints(wide).find("does not fit on the nearest wall"), std::string::npos);
  json high = test::two_rooms_json();
  high["doors"][0]["height"] = 2.45;  // room b's floor is 0.1 m up
  EXPECT_NE(complaints(high).find("higher than the lower"), std::string::npos);
  json wrong_wall = test::two_rooms_json();
  wrong_wall["doors"][0]["at"] = {0.0, 1.5};
  EXPECT_NE(complaints(wrong_wall).find("is not behind this wall"), std::string::npos);
}

TEST(SceneJson, WindowsThroughTheCeilingAndShaftsOutsideTheRoomsAreRefused) {
  json scene = test::two_rooms_json();
  scene["windows"] = json::parse(R"([{"room": "a", "at": [2, 0], "sill": 2}])");
  scene["shafts"] = json::parse(R"([{"between": ["a", "b"], "polygon": [[1,1],[2,1],[2,2]]}])");
  const std::string text = complaints(scene);
  EXPECT_NE(text.find("windows[0] reaches through the ceiling"), std::string::npos) << text;
  EXPECT_NE(text.find("shafts[0] must lie inside the plans"), std::string::npos) << text;
}

}  // namespace
}  // namespace roomcut::synthesize

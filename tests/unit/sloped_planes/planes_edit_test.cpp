// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/unit/sloped_planes/planes_fixture.h"

namespace roomcut {
namespace {

using nlohmann::json;
using testing::document;
using testing::drawn;
using testing::edited;
using testing::gable;
using testing::plane_named;

TEST(PlanesEdit, AnUntouchedCopyIsTheDetection) {
  const PlanesFile file = edited(document());
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_EQ(file.payload_sha256, planes_payload_sha256(gable()));
}

TEST(PlanesEdit, LayoutOrderDirectionAndTextFieldsDoNotMatter) {
  json copy = document();
  std::reverse(copy["features"].begin(), copy["features"].end());
  for (json& feature : copy["features"]) {
    json& ring = feature["geometry"]["coordinates"][0];
    ring.erase(ring.size() - 1);                              // not closed
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());  // another first corner
    std::reverse(ring.begin(), ring.end());                   // the other way round
    json& properties = feature["properties"];
    properties["pitch_deg"] = " " + properties["pitch_deg"].dump() + " ";
    properties["uphill_deg"] = properties["uphill_deg"].get<double>() - 360;
    properties["locked"] = "no";
    properties.erase("side");
    properties["height_m"] = nullptr;
    feature["geometry"]["type"] = "MultiPolygon";
    feature["geometry"]["coordinates"] = json::array({feature["geometry"]["coordinates"]});
  }
  EXPECT_EQ(edited(copy).payload_sha256, planes_payload_sha256(gable()));
}

TEST(PlanesEdit, ANewPlaneNeedsItsOutlineAndThreeNumbersOnly) {
  json copy = document();
  copy["features"].push_back(
      drawn({{1, 1}, {3, 1}, {3, 5}, {1, 5}}, {{"pitch_deg", 45}, {"uphill_deg", 0}, {"height_m", 253}}));
  const PlanesFile file = edited(copy);
  ASSERT_EQ(file.content.planes.size(), 4U);
  const PlaneFeature& added = plane_named(file, "e0001");
  EXPECT_EQ(added.source, LineSource::kAdded);
  EXPECT_NEAR(added.plane.gradient.x(), 1, 1e-9);
  EXPECT_NEAR(added.plane.gradient.y(), 0, 1e-9);
  EXPECT_NEAR(added.plane.height(Vec2(2, 3)), 3, 1e-6);
  EXPECT_TRUE(added.plane.ceiling);
  EXPECT_EQ(plane_named(file, "p0001").source, LineSource::kDetected);
}

TEST(PlanesEdit, AnotherPitchTurnsThePlaneAboutItsMiddleAndKeepsWhatIsLeftOut) {
  json copy = document();
  copy["features"][0]["properties"] = {{"plane_id", "p0001"}, {"pitch_deg", 30}, {"survey", "yes"}};
  const PlaneFeature plane = plane_named(edited(copy), "p0001");
  EXPECT_EQ(plane.source, LineSource::kEdited);
  EXPECT_NEAR(plane.plane.gradient.norm(), std::tan(std::numbers::pi / 6), 1e-8);
  EXPECT_NEAR(plane.plane.gradient.x(), 0, 1e-8);
  EXPECT_NEAR(plane.plane.height(Vec2(4, 1.5)), 3.25, 1e-6);
  EXPECT_EQ(plane.extra_json, R"({"survey":"yes"})");
}

TEST(PlanesEdit, AnOutlineThatIsRedrawnLeavesThePlaneWhereItIs) {
  json copy = document();
  json properties = copy["features"][0]["properties"];
  copy["features"][0] = drawn({{0, -1}, {8, -1}, {8, 3}, {0, 3}}, properties);
  const PlaneFeature plane = plane_named(edited(copy), "p0001");
  EXPECT_EQ(plane.source, LineSource::kEdited);
  EXPECT_NEAR(plane.plane.height(Vec2(4, 1.5)), 3.25, 1e-5);
  EXPECT_NEAR(plane.plane.height(Vec2(4, -1)), 2, 1e-5);
}

TEST(PlanesEdit, DeletedPlanesAreGoneAllOfThemToo) {
  json copy = document();
  copy["features"].erase(1);
  EXPECT_EQ(edited(copy).content.planes.size(), 2U);
  copy["features"] = json::array();
  EXPECT_TRUE(edited(copy).content.planes.empty());
}

TEST(PlanesEdit, ACopiedIdStaysWithThePlaneThatWasNotMoved) {
  json copy = document();
  json moved = drawn({{0, 1}, {8, 1}, {8, 4}, {0, 4}}, copy["features"][0]["properties"]);
  copy["features"].insert(copy["features"].begin(), moved);
  copy["features"].push_back(copy["features"][2]);
  const PlanesFile file = edited(copy);
  EXPECT_EQ(plane_named(file, "p0001").source, LineSource::kDetected);
  EXPECT_EQ(file.content.planes.size(), 4U);  // one added; the copy that lies on its original is dropped
  EXPECT_EQ(file.warnings.size(), 3U);
}

TEST(PlanesEdit, WhatCannotBeMeantIsSaidAndTheRestTaken) {
  json copy = document();
  copy["features"].push_back(drawn({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {0, 1}},
                                   {{"pitch_deg", 20}, {"uphill_deg", 0}, {"height_m", 252}}));
  copy["features"].back()["geometry"]["coordinates"].push_back(
      copy["features"][2]["geometry"]["coordinates"][0]);
  const PlanesFile file = edited(copy);
  EXPECT_EQ(file.warnings.size(), 2U);  // not convex; a hole
  EXPECT_EQ(plane_named(file, "e0001").plane.outline.size(), 5U);
}

TEST(PlanesEdit, ABaseThatIsNoDigestIsNoBase) {
  json copy = document();
  copy["roomcut"]["base_sha256"] = "the one of May";
  const PlanesFile file = edited(copy);
  EXPECT_TRUE(file.content.base_sha256.empty());
  EXPECT_EQ(file.warnings.size(), 1U);
}

TEST(PlanesEdit, WithoutTheMemberCoordinatesAreThoseInWhichThePlanesLieInTheScan) {
  json copy = document();
  copy.erase("roomcut");
  EXPECT_EQ(edited(copy).payload_sha256, planes_payload_sha256(gable()));
  for (json& feature : copy["features"]) {
    for (json& corner : feature["geometry"]["coordinates"][0]) {
      corner[0] = corner[0].get<double>() - testing::kEast;
      corner[1] = corner[1].get<double>() - testing::kNorth;
    }
    feature["properties"]["height_m"] = feature["properties"]["height_m"].get<double>() - testing::kHigh;
  }
  const PlanesFile local = edited(copy);
  EXPECT_EQ(local.payload_sha256, planes_payload_sha256(gable()));
  EXPECT_EQ(local.warnings.size(), 2U);
}

}  // namespace
}  // namespace roomcut

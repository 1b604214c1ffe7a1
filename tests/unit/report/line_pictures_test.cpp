// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "stages/tools/report/pictures.h"
#include "tests/unit/report/count.h"

namespace roomcut::report {
namespace {

TEST(LinePictures, SlopedPlanesAreOutlinesWithAnArrowNameAndPitch) {
  AcceptedPlanes planes;
  for (const bool ceiling : {true, false}) {
    PlaneFeature feature;
    feature.id = ceiling ? "p0001" : "p0002";
    feature.plane.gradient = {ceiling ? 1.0 : 0.1, 0};
    feature.plane.outline = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
    feature.plane.ceiling = ceiling;
    planes.planes.push_back(feature);
  }
  WallLine wall;
  wall.b = {4, 0};
  const Picture picture = draw_planes(planes, {wall});
  EXPECT_EQ(picture.file, "accept_planes.svg");
  EXPECT_EQ(count(picture.bytes, "<polygon"), 2U);
  EXPECT_EQ(count(picture.bytes, "<line"), 1U + 2 * 3);
  EXPECT_NE(picture.bytes.find("p0001 45.0 deg"), std::string::npos);
  EXPECT_NE(picture.bytes.find("p0002: 5.7 degrees, 0.20 m high"), std::string::npos);
}

TEST(LinePictures, WithoutSlopedPlanesTheLinesAreThere) {
  WallLine wall;
  wall.b = {4, 0};
  EXPECT_EQ(count(draw_planes({}, {wall}).bytes, "<line"), 1U);
}

}  // namespace
}  // namespace roomcut::report

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <sstream>

#include "common/artefact/json_values.h"
#include "tests/unit/wall_lines/lines_fixture.h"

namespace roomcut {
namespace {

using testing::Folder;
using testing::line_of;
using testing::save;

class Edit : public ::testing::Test {
 protected:
  /// The first version's lines as a JSON document that a test may change, and as the base they are compared
  /// with. The base holds them all as detected, without the user's own properties.
  Edit() {
    document_ = Json::parse(std::ifstream(testing::kFirstVersion));
    base_ = read_wall_lines(testing::kFirstVersion).content;
    for (WallLine& line : base_.lines) {
      line.source = LineSource::kDetected;
    }
  }

  Json& feature(const std::string& id) {
    for (Json& item : document_["features"]) {
      if (item["properties"].contains("wall_id") && item["properties"]["wall_id"] == id) {
        return item;
      }
    }
    throw std::runtime_error("no feature " + id);
  }

  WallLinesFile read() const {
    return read_edited_wall_lines(save(folder_ / "edit.geojson", document_.dump(1)), base_);
  }
  static bool warned(const WallLinesFile& file, const std::string& word) {
    return std::any_of(file.warnings.begin(), file.warnings.end(),
                       [&](const std::string& text) { return text.find(word) != std::string::npos; });
  }
  static Json drawn(const std::string& coordinates) {
    return {{"type", "Feature"},
            {"properties", Json::object()},
            {"geometry", {{"type", "LineString"}, {"coordinates", Json::parse(coordinates)}}}};
  }

  Folder folder_;
  Json document_;
  WallLines base_;
};

TEST_F(Edit, AnUntouchedCopyIsTheBaseWhateverItsLayout) {
  const WallLinesFile file = read();
  EXPECT_EQ(file.payload_sha256, wall_lines_payload_sha256(base_));
  EXPECT_TRUE(file.warnings.empty());
  std::reverse(document_["features"].begin(), document_["features"].end());
  EXPECT_EQ(read().payload_sha256, file.payload_sha256);
}

TEST_F(Edit, DirectionMeansNothing) {
  auto& points = feature("w0003")["geometry"]["coordinates"];
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(read().payload_sha256, wall_lines_payload_sha256(base_));
}

TEST_F(Edit, FifteenDecimalsAreNoMove) {
  feature("w0005")["geometry"]["coordinates"][0][0] = -0.060000000000000012;
  feature("w0005")["geometry"]["coordinates"][1][0] = -0.0600003;
  EXPECT_EQ(read().payload_sha256, wall_lines_payload_sha256(base_));
}

TEST_F(Edit, AMovedLineIsEditedWhateverItSays) {
  feature("w0005")["geometry"]["coordinates"] = Json::parse("[[-0.1, -3], [-0.1, 3]]");
  feature("w0005")["properties"]["source"] = "detected";
  const WallLine line = line_of(read().content, "w0005");
  EXPECT_EQ(line.source, LineSource::kEdited);
  EXPECT_DOUBLE_EQ(line.support_m, 6);
  EXPECT_EQ(line.sigma_offset_m, 0);
  EXPECT_EQ(line_of(read().content, "w0006").source, LineSource::kDetected);
}

TEST_F(Edit, ADeletedLineIsGone) {
  document_["features"].erase(0);
  EXPECT_EQ(read().content.lines.size(), 7U);
}

TEST_F(Edit, OnlyGeometryIsAskedOfTheUser) {
  document_["features"].push_back(drawn("[[1, 1], [2, 1]]"));
  document_["features"].push_back({{"type", "Feature"}, {"geometry", drawn("[[1, 0], [2, 0]]")["geometry"]}});
  const WallLines lines = read().content;
  ASSERT_EQ(lines.lines.size(), 10U);
  const WallLine& first = line_of(lines, "e0002");  // e0001 is taken; the order is that of the coordinates
  EXPECT_EQ(first.a, Vec2(1, 0));
  EXPECT_EQ(first.source, LineSource::kAdded);
  EXPECT_DOUBLE_EQ(first.support_m, 1);
  EXPECT_EQ(line_of(lines, "e0003").a, Vec2(1, 1));
}

TEST_F(Edit, APolylineIsSplit) {
  feature("w0005")["geometry"]["coordinates"] = Json::parse("[[-0.06, -3], [-0.06, 0], [-0.06, 0], [-1, 3]]");
  document_["features"].push_back(drawn("[[1, 1], [2, 1], [2, 2]]"));
  const WallLines lines = read().content;
  EXPECT_EQ(line_of(lines, "w0005.1").b, Vec2(-0.06, 0));
  EXPECT_EQ(line_of(lines, "w0005.2").source, LineSource::kEdited);
  EXPECT_EQ(line_of(lines, "e0003").source, LineSource::kAdded);
  EXPECT_EQ(lines.lines.size(), 7U + 2U + 2U);
}

TEST_F(Edit, ACopiedIdIsKeptByTheUnmovedLine) {
  Json copy = feature("w0005");
  copy["geometry"]["coordinates"] = Json::parse("[[-2, -3], [-2, 3]]");
  document_["features"].insert(document_["features"].begin(), copy);
  const WallLinesFile file = read();
  EXPECT_EQ(line_of(file.content, "w0005").a, Vec2(-0.06, -3));
  EXPECT_EQ(line_of(file.content, "e0002").a, Vec2(-2, -3));
  EXPECT_EQ(line_of(file.content, "e0002").source, LineSource::kAdded);
  EXPECT_TRUE(warned(file, "wall_id w0005"));
}

TEST_F(Edit, ACopyThatWasNotMovedIsDropped) {
  document_["features"].push_back(feature("w0005"));
  const WallLinesFile file = read();
  EXPECT_EQ(file.payload_sha256, wall_lines_payload_sha256(base_));
  EXPECT_TRUE(warned(file, "lies exactly on w0005"));
}

TEST_F(Edit, AMultiLineStringOfOnePartIsALine) {
  Json& geometry = feature("w0001")["geometry"];
  geometry = {{"type", "MultiLineString"}, {"coordinates", Json::array({geometry["coordinates"]})}};
  EXPECT_EQ(read().payload_sha256, wall_lines_payload_sha256(base_));
}

TEST_F(Edit, TextIsTakenWhereItMeansANumberOrATruth) {
  feature("w0001")["geometry"]["coordinates"][0][0] = " -5.000 ";
  feature("w0001")["properties"]["support_m"] = "9.0";
  feature("w0001")["properties"]["locked"] = "False";
  feature("w0007")["properties"]["locked"] = 1;
  for (const char* levels : {"[2, 0]", "(2:0,2)", "0, 2"}) {
    feature("w0007")["properties"]["levels"] = levels;
    EXPECT_EQ(read().payload_sha256, wall_lines_payload_sha256(base_)) << levels;
  }
}

TEST_F(Edit, AThirdCoordinateIsIgnoredWithAWarning) {
  feature("w0001")["geometry"]["coordinates"][0].push_back(2.5);
  const WallLinesFile file = read();
  EXPECT_EQ(file.payload_sha256, wall_lines_payload_sha256(base_));
  EXPECT_TRUE(warned(file, "heights"));
}

TEST_F(Edit, UnknownPropertiesAreKeptAndEmptyOnesAreNot) {
  feature("w0001")["properties"]["owner"] = {{"name", "Ada"}};
  feature("w0001")["properties"]["nothing"] = nullptr;
  EXPECT_EQ(line_of(read().content, "w0001").extra_json, R"({"owner":{"name":"Ada"}})");
}

TEST_F(Edit, WithoutTheMemberTheBaseIsTakenWithAWarning) {
  document_.erase("roomcut");
  document_.erase("crs");
  const WallLinesFile file = read();
  EXPECT_EQ(file.payload_sha256, wall_lines_payload_sha256(base_));
  EXPECT_TRUE(warned(file, "`roomcut` is missing"));
  EXPECT_EQ(file.content.base_sha256, "");
}

TEST_F(Edit, ABaseThatIsNoDigestIsNoBase) {
  document_["roomcut"]["base_sha256"] = "the one of May";
  const WallLinesFile file = read();
  EXPECT_TRUE(warned(file, "base_sha256 is no digest"));
  EXPECT_EQ(file.content.base_sha256, "");
}

TEST_F(Edit, AMovedOriginMovesTheLinesAlong) {
  base_.frame.origin[0] += 0.25;
  for (WallLine& line : base_.lines) {
    line.a.x() -= 0.25;
    line.b.x() -= 0.25;
  }
  const WallLinesFile file = read();
  EXPECT_EQ(file.payload_sha256, wall_lines_payload_sha256(base_));
  EXPECT_TRUE(warned(file, "origin moved"));
}

TEST_F(Edit, AcceptedLinesReadAgainGiveTheSameLines) {
  feature("w0005")["geometry"]["coordinates"] = Json::parse("[[-0.0612345678, -3], [-0.06, 0], [-1, 3]]");
  document_["features"].push_back(drawn("[[1, 1], [2.123456789, 1]]"));
  const WallLinesFile once = read();
  write_wall_lines(folder_ / "accepted.geojson", once.content, {});
  EXPECT_EQ(read_edited_wall_lines(folder_ / "accepted.geojson", base_).payload_sha256, once.payload_sha256);
}

TEST_F(Edit, EmptyPropertiesOfANewFeatureAreFine) {
  Json line = drawn("[[1, 1], [2, 1]]");
  for (const char* name : {"wall_id", "source", "locked", "levels", "support_m", "rms_m", "note"}) {
    line["properties"][name] = nullptr;
  }
  document_["features"].push_back(line);
  EXPECT_FALSE(line_of(read().content, "e0002").locked);
}

}  // namespace
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/openings/openings_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "common/geometry/scan_coordinates.h"

namespace roomcut::find_openings {
namespace {

namespace fs = std::filesystem;

class OpeningsIo : public testing::Test {
 protected:
  fs::path path_ = fs::path(testing::TempDir()) / "roomcut_openings.geojson";
  void TearDown() override { fs::remove(path_); }

  static Openings two() {
    Openings openings;
    openings.frame.origin[0] = 500000.25;
    openings.cells_payload_sha256 = std::string(64, 'a');
    for (const int i : {2, 1}) {
      Opening opening;
      opening.id = "o000" + std::to_string(i);
      opening.wall_a = "w1";
      opening.wall_b = "w\"2";
      opening.jamb_a = {1.0 * i, 2.123456789};
      opening.jamb_b = {0.1, 2.0};
      opening.thickness_m = 0.12;
      opening.head_z = 2.05;
      opening.proof_a = {100, 0.9, 0.0005};
      openings.openings.push_back(opening);
    }
    return openings;
  }
  std::string code() const {
    try {
      read_openings(path_, std::string(64, 'a'));
    } catch (const StageError& error) {
      return error.problems().front().code.id;
    }
    return "";
  }
};

TEST_F(OpeningsIo, AChangedOrImpossibleNumberIsDamage) {
  write_openings(path_, two(), {});
  std::ostringstream held;
  held << std::ifstream(path_).rdbuf();
  const auto code_with = [&](const std::string& from, const std::string& to) {
    std::string text = held.str();
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::ofstream(path_) << text;
    return code();
  };
  EXPECT_EQ(code_with("2.050000", "2.050000"), "");
  EXPECT_EQ(code_with("2.050000", "2.150000"), "A02");
  EXPECT_EQ(code_with("2.050000", "1e308"), "A02");
  EXPECT_EQ(code_with("2.050000", "1e999"), "A02");
  EXPECT_EQ(code_with(R"("points": 100)", R"("points": -1)"), "A02");
  EXPECT_EQ(code_with(R"("points": 100)", R"("points": "many")"), "A02");
  EXPECT_EQ(code_with("2.050000", std::string(1000, '[') + std::string(1000, ']')), "A02");
}

TEST_F(OpeningsIo, WhatIsWrittenIsReadSortedAndRounded) {
  EXPECT_TRUE(write_openings(path_, two(), {}));
  EXPECT_FALSE(write_openings(path_, two(), {})) << "an equal payload is not new";
  const OpeningsFile file = read_openings(path_, std::string(64, 'a'));
  ASSERT_EQ(file.content.openings.size(), 2U);
  const Opening& first = file.content.openings[0];
  EXPECT_EQ(first.id, "o0001");
  EXPECT_EQ(first.wall_b, "w\"2");
  EXPECT_EQ(first.jamb_a, Vec2(0.1, 2.0)) << "the lesser end comes first …";
  EXPECT_EQ(first.jamb_b, Vec2(1.0, 2.123457));
  EXPECT_EQ(first.proof_b.points, 100U) << "… and its proof with it";
  EXPECT_EQ(file.content.frame.origin[0], 500000.25);
  EXPECT_EQ(read_openings(path_).payload_sha256, file.payload_sha256);
}

TEST_F(OpeningsIo, OfALevelledScanTheFileHoldsTheScansOwnAndTheReaderLocalOnes) {
  Openings openings = two();
  openings.frame.origin[1] = 5334567.654321;
  openings.frame.origin[2] = 512.5;
  openings.frame.level[0] = 0.05;
  openings.frame.level[2] = std::sqrt(1 - 0.0025);
  openings.frame.crs = "EPSG:25832";
  write_openings(path_, openings, {});
  const OpeningsFile file = read_openings(path_);
  EXPECT_FALSE(write_openings(path_, file.content, {})) << "read and written again, nothing is new";
  const Opening& first = file.content.openings[0];
  EXPECT_LT((first.jamb_a - Vec2(0.1, 2.0)).norm(), 2e-6);
  EXPECT_NEAR(first.head_z, 2.05, 2e-6);
  const Json document = Json::parse(std::ifstream(path_));
  EXPECT_EQ(document["crs"]["properties"]["name"], "EPSG:25832");
  const Json& feature = document["features"][0];
  const ScanCoordinates scan(openings.frame);
  const Vec2 wanted = scan.plan_to_scan({0.1, 2.0});
  EXPECT_NEAR(feature["geometry"]["coordinates"][0][0].get<double>(), wanted.x(), 1e-6);
  EXPECT_NEAR(feature["geometry"]["coordinates"][0][1].get<double>(), wanted.y(), 1e-6);
  EXPECT_NEAR(feature["properties"]["head_z_m"].get<double>(), scan.to_scan(Vec3(0.55, 2.06, 2.05)).z(),
              1e-3);
}

TEST_F(OpeningsIo, NoOpeningIsAFileToo) {
  Openings none;
  none.cells_payload_sha256 = std::string(64, 'a');
  write_openings(path_, none, {});
  EXPECT_TRUE(read_openings(path_, std::string(64, 'a')).content.openings.empty());
}

TEST_F(OpeningsIo, OtherCellsAreA05AndDamageIsA02NamingTheFeature) {
  Openings openings = two();
  openings.cells_payload_sha256 = std::string(64, 'b');
  write_openings(path_, openings, {});
  EXPECT_EQ(code(), "A05");
  openings = two();
  openings.openings[0].head_z = openings.openings[0].sill_z;
  write_openings(path_, openings, {});
  EXPECT_EQ(code(), "A02");
  std::ofstream(path_) << "{\"type\": \"FeatureCollection\"}";
  EXPECT_EQ(code(), "A02");
  std::ofstream(path_) << "not JSON";
  EXPECT_EQ(code(), "A02");
}

}  // namespace
}  // namespace roomcut::find_openings

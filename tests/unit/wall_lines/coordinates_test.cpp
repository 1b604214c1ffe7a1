// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/artefact/json_values.h"
#include "common/geometry/scan_coordinates.h"
#include "tests/unit/wall_lines/lines_fixture.h"

namespace roomcut {
namespace {

using testing::Folder;
using testing::line_of;
using testing::make_line;
using testing::save;

/// Lines of a scan in UTM that leans by `lean` radians.
WallLines far_lines(double lean) {
  WallLines lines;
  lines.frame.origin[0] = 691234.123456;
  lines.frame.origin[1] = 5334567.654321;
  lines.frame.origin[2] = 512.5;
  lines.frame.level[0] = 0.6 * std::sin(lean);
  lines.frame.level[1] = 0.8 * std::sin(lean);
  lines.frame.level[2] = std::cos(lean);
  lines.bbox_min = {-5, -3};
  lines.bbox_max = {6, 4};
  lines.lines = {make_line("w0001", {-4.9, -2.9}, {5.9, -2.8}), make_line("w0002", {5.9, -2.8}, {5.7, 3.9}),
                 make_line("w0003", {0.1234567, -2.9}, {0.2, 3.9})};
  return lines;
}

Json document_of(const std::filesystem::path& path) {
  return Json::parse(std::ifstream(path));
}

class Coordinates : public ::testing::TestWithParam<double> {
 protected:
  Coordinates() {
    write_wall_lines(folder_ / "lines.geojson", far_lines(GetParam()), {});
    base_ = read_wall_lines(folder_ / "lines.geojson").content;
    document_ = document_of(folder_ / "lines.geojson");
  }
  WallLinesFile read_edit() const {
    return read_edited_wall_lines(save(folder_ / "edit.geojson", document_.dump()), base_);
  }
  /// Points of the document, changed.
  template <class Change>
  void each_point(Change change) {
    for (Json& feature : document_["features"]) {
      for (Json& point : feature["geometry"]["coordinates"]) {
        const Vec2 p = change(Vec2(point[0].get<double>(), point[1].get<double>()));
        point = {p.x(), p.y()};
      }
    }
  }
  static bool says(const WallLinesFile& file, const std::string& words) {
    return std::any_of(file.warnings.begin(), file.warnings.end(),
                       [&](const std::string& text) { return text.find(words) != std::string::npos; });
  }

  Folder folder_;
  WallLines base_;
  Json document_;
};

TEST_P(Coordinates, the_file_holds_the_scans_own_and_the_reader_local_ones) {
  EXPECT_EQ(document_["roomcut"]["coordinates"], "scan");
  const WallLines wanted = far_lines(GetParam());
  const ScanCoordinates scan(wanted.frame);
  for (const Json& feature : document_["features"]) {
    const WallLine& line = line_of(wanted, feature["properties"]["wall_id"].get<std::string>());
    const Json& first = feature["geometry"]["coordinates"][0];
    const Vec2 written(first[0].get<double>(), first[1].get<double>());
    EXPECT_LT(
        std::min((written - scan.plan_to_scan(line.a)).norm(), (written - scan.plan_to_scan(line.b)).norm()),
        1e-6);
  }
  for (const WallLine& line : base_.lines) {
    EXPECT_LT((line.centre() - line_of(wanted, line.id).centre()).norm(), 1e-6);
  }
  EXPECT_LT((base_.bbox_max - wanted.bbox_max).norm(), 1e-6);
}

TEST_P(Coordinates, reading_and_writing_again_changes_nothing) {
  write_wall_lines(folder_ / "again.geojson", base_, {});
  EXPECT_EQ(document_of(folder_ / "again.geojson"), document_);
  EXPECT_EQ(read_edit().payload_sha256, wall_lines_payload_sha256(base_));
  EXPECT_TRUE(read_edit().warnings.empty());
}

TEST_P(Coordinates, a_line_moved_in_the_scans_own_moves_by_that_much) {
  document_["features"][0]["geometry"]["coordinates"][0][1] =
      document_["features"][0]["geometry"]["coordinates"][0][1].get<double>() + 0.25;
  const WallLinesFile file = read_edit();
  double moved = 0;
  for (const WallLine& line : file.content.lines) {
    const WallLine& before = line_of(base_, line.id);
    moved += (line.a - before.a).norm() + (line.b - before.b).norm();
  }
  EXPECT_NEAR(moved, 0.25, 0.002) << "a leaning plan is a little shorter than the level one";
}

TEST_P(Coordinates, an_edit_of_version_1_0_is_local_as_it_was) {
  const ScanCoordinates scan(base_.frame);
  each_point([&](const Vec2& p) { return scan.plan_to_local(p); });
  document_["roomcut"]["schema_version"] = "1.0";
  document_["roomcut"].erase("coordinates");
  EXPECT_EQ(read_edit().payload_sha256, wall_lines_payload_sha256(base_));
}

TEST_P(Coordinates, without_the_member_the_unmoved_lines_tell_which_they_are_and_it_is_said) {
  document_.erase("roomcut");
  EXPECT_EQ(read_edit().payload_sha256, wall_lines_payload_sha256(base_));
  EXPECT_TRUE(says(read_edit(), "the scan's own coordinates"));
  const ScanCoordinates scan(base_.frame);
  each_point([&](const Vec2& p) { return scan.plan_to_local(p); });
  EXPECT_EQ(read_edit().payload_sha256, wall_lines_payload_sha256(base_));
  EXPECT_TRUE(says(read_edit(), "local coordinates"));
}

TEST_P(Coordinates, without_the_member_lines_all_drawn_anew_are_taken_where_they_lie_in_the_scan) {
  document_.erase("roomcut");
  each_point([](const Vec2& p) { return Vec2(p + Vec2(0.4, 0.4)); });
  EXPECT_TRUE(says(read_edit(), "the scan's own coordinates"));
}

TEST_P(Coordinates, an_edit_in_the_scans_own_stays_where_it_is_when_the_origin_moves) {
  WallLines moved = base_;
  moved.frame.origin[0] += 10;
  const Vec2 by =
      ScanCoordinates(moved.frame).plan_to_local(ScanCoordinates(base_.frame).plan_to_scan({0, 0}));
  for (WallLine& line : moved.lines) {
    line.a += by;
    line.b += by;
  }
  moved.bbox_min += by;
  moved.bbox_max += by;
  const WallLinesFile file = read_edited_wall_lines(save(folder_ / "edit.geojson", document_.dump()), moved);
  EXPECT_EQ(file.payload_sha256, wall_lines_payload_sha256(moved));
  EXPECT_TRUE(file.warnings.empty());
}

INSTANTIATE_TEST_SUITE_P(LevelAndLeaning, Coordinates, ::testing::Values(0.0, 0.014, 0.08));

TEST(CoordinateSystem, of_the_scan_travels_where_the_numbers_are_those_of_the_scan) {
  const Folder folder;
  WallLines lines = far_lines(0);
  lines.frame.crs = "EPSG:25832";
  write_wall_lines(folder / "lines.geojson", lines, {});
  EXPECT_EQ(document_of(folder / "lines.geojson")["crs"]["properties"]["name"], "EPSG:25832");
  EXPECT_EQ(read_wall_lines(folder / "lines.geojson").content.frame.crs, "EPSG:25832");
  lines.frame.unit = "ft";
  write_wall_lines(folder / "feet.geojson", lines, {});
  const std::string name = document_of(folder / "feet.geojson")["crs"]["properties"]["name"];
  EXPECT_EQ(name.substr(0, 8), "LOCAL_CS") << "metres are no feet";
}

}  // namespace
}  // namespace roomcut

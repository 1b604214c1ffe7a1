// SPDX-License-Identifier: GPL-3.0-or-later
// The program itself, on files: what it writes, and what it refuses.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/artefact/h5.h"
#include "common/artefact/json_values.h"
#include "common/cells/cells_io.h"
#include "common/cloud/cloud_io.h"
#include "common/geometry/scan_coordinates.h"
#include "common/mesh/mesh_io.h"
#include "tests/unit/cells/three_faces.h"
#include "tests/unit/mesh/shapes.h"

namespace roomcut::evaluate {
namespace {

namespace fs = std::filesystem;
using test::append;
using test::box;

Labels all_solid(const CellComplex& complex) {
  Labels labels;
  labels.label.assign(complex.cells(), 0);
  labels.margin_m3.assign(complex.cells(), 0);
  labels.unobserved.assign(complex.cells(), 0);
  return labels;
}

class EvaluateProgram : public testing::Test {
 protected:
  void SetUp() override {
    work_ = fs::path(testing::TempDir()) / "roomcut evaluate ü";
    fs::remove_all(work_);
    fs::create_directories(work_);
    TriangleMesh rooms = box({0, 0, 0}, {4, 3, 2.5});
    append(rooms, box({4.1, 0, 0}, {8, 3, 2.5}));
    write("truth.off", off_text(rooms, {0, 0, 0}));
    write("model.ply", ply_bytes(rooms, {0, 0, 0}, {}));
  }
  void TearDown() override { fs::remove_all(work_); }

  void write(const std::string& name, const std::string& content) const {
    std::ofstream(work_ / name, std::ios::binary) << content;
  }
  std::string read(const std::string& name) const {
    std::ifstream file(work_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  int run(const std::string& options = "") const {
    const std::string command =
        std::string("cd '") + work_.string() + "' && '" + ROOMCUT_BIN_DIR +
        "/evaluate' --work . --set column_spacing_m=0.05 --set sample_spacing_m=0.1 " +
        (options.empty() ? "--truth truth.off" : options) + " > stdout 2> stderr";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  // The program ends with exit code 3 and this error.
  void expect_refused(const std::string& id, const std::string& options = "") const {
    EXPECT_EQ(run(options), 3) << id;
    EXPECT_NE(read("stderr").find("error[" + id + "]"), std::string::npos) << read("stderr");
    EXPECT_FALSE(fs::exists(work_ / "evaluate")) << "nothing is left behind";
  }

  fs::path work_;
};

TEST_F(EvaluateProgram, WritesScoresPictureAndColouredModelAndPrintsATable) {
  ASSERT_EQ(run(), 0) << read("stderr");
  const Json scores = read_json_artefact(work_ / "evaluate/scores.json", artefacts::kScores);
  EXPECT_DOUBLE_EQ(scores.at("volume").at("iou").get<double>(), 1);
  EXPECT_EQ(scores.at("rooms").at("found").get<int>(), 2);
  EXPECT_LT(scores.at("distance").at("symmetric").at("hausdorff_m").get<double>(), 1e-9);
  EXPECT_GT(read_mesh(work_ / "evaluate/distance.ply").triangles.size(), 1000U);
  EXPECT_EQ(read("evaluate/distance.png").substr(1, 3), "PNG");
  EXPECT_NE(read("stdout").find("2 of 2 found"), std::string::npos) << read("stdout");
}

TEST_F(EvaluateProgram, RoomsOfATruthJsonKeepTheirNames) {
  write("truth.json", R"({"rooms": [
    {"name": "kitchen", "floor": 0, "ceiling": 2.5, "center": [1, 1, 1]},
    {"name": "hall", "floor": 0, "ceiling": 2.5, "polygon": [[4.1, 0], [8, 0], [8, 3], [4.1, 3]]}]})");
  ASSERT_EQ(run(), 0) << read("stderr");
  const Json list =
      read_json_artefact(work_ / "evaluate/scores.json", artefacts::kScores).at("rooms").at("list");
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list.at(0).at("name"), "kitchen");
  EXPECT_EQ(list.at(1).at("name"), "hall");
  EXPECT_NEAR(list.at(1).at("volume_m3").get<double>(), 3.9 * 3 * 2.5, 0.5);
}

TEST_F(EvaluateProgram, ColumnsAndNichesAreReadFromTheTruthJson) {
  write(
      "truth.json",
      R"({"rooms": [{"name": "hall", "floor": 0, "ceiling": 2.5, "polygon": [[4.1, 0], [8, 0], [8, 3], [4.1, 3]]}],
    "columns": [{"polygon": [[4.02, 1], [4.08, 1], [4.08, 2], [4.02, 2]], "width": 0.06, "depth": 1, "z0": 0, "z1": 2.5},
                {"polygon": [[5, 1], [6, 1], [6, 2], [5, 2]], "width": 1, "depth": 1, "z0": 0, "z1": 2.5}],
    "niches": [{"polygon": [[7.8, 0], [8, 0], [8, 3], [7.8, 3]], "width": 3, "depth": 0.2, "z0": 0, "z1": 2.5, "pilaster": false}]})");
  ASSERT_EQ(run("--truth truth.off --truth-json truth.json"), 0) << read("stderr");
  const Json scores = read_json_artefact(work_ / "evaluate/scores.json", artefacts::kScores);
  EXPECT_EQ(scores.at("columns").at("truth").get<int>(), 2);
  EXPECT_EQ(scores.at("columns").at("found").get<int>(),
            1);  // the wall between the rooms; the other is empty
  EXPECT_NEAR(scores.at("columns").at("list").at(0).at("size_m").get<double>(), 0.06, 1e-9);
  EXPECT_NEAR(scores.at("niches").at("area_m2").get<double>(), 3 * 2.5 + 2 * 0.2 * (3 + 2.5), 0.3);
  EXPECT_DOUBLE_EQ(scores.at("niches").at("within_2cm").get<double>(), 1);
  EXPECT_NEAR(scores.at("rooms").at("list").at(0).at("ceiling_off_m").get<double>(), 0, 1e-9);
  EXPECT_NE(read("stdout").find("1 of 2 found, 0 false"), std::string::npos) << read("stdout");
}

TEST_F(EvaluateProgram, IgnoredBoxesAndRoomsThatNobodyEnteredAreReadFromTheTruthJson) {
  write("truth.json", R"({"rooms": [
    {"name": "kitchen", "floor": 0, "ceiling": 2.5, "center": [1, 1, 1], "scanned": false},
    {"name": "hall", "floor": 0, "ceiling": 2.5, "center": [5, 1, 1], "scanned": true}],
    "ignore_boxes": [[[20, 3, 2.5], [8.1, 0, 0]]]})");
  TriangleMesh more = box({4.1, 0, 0}, {8, 3, 2.5});
  append(more, box({8.2, 0, 0}, {12, 3, 2.5}));
  write("model.ply", ply_bytes(more, {0, 0, 0}, {}));
  ASSERT_EQ(run("--truth truth.off --truth-json truth.json"), 0) << read("stderr");
  const Json scores = read_json_artefact(work_ / "evaluate/scores.json", artefacts::kScores);
  EXPECT_NEAR(scores.at("volume").at("seen").at("iou").get<double>(), 1, 1e-6);
  EXPECT_NEAR(scores.at("volume").at("ignored_m3").get<double>(), 28.5, 0.5);
  EXPECT_NEAR(scores.at("volume").at("precision").get<double>(), 1, 1e-6);
  EXPECT_EQ(scores.at("rooms").at("unentered").at("denied").get<int>(), 1);
  EXPECT_EQ(scores.at("rooms").at("list").at(0).at("answer"), "denied");
}

// The wall between the rooms is open from y = 1.2 on, and scanned up to there.
TEST_F(EvaluateProgram, TheScanTellsADoorUpToTheCeilingFromALostWallAndKeepsItsOwnFrame) {
  TriangleMesh open = box({0, 0, 0}, {4, 3, 2.5});
  append(open, box({4.1, 0, 0}, {8, 3, 2.5}));
  append(open, box({3.9, 1.2, 0.001}, {4.2, 2.999, 2.499}));
  write("model.ply", ply_bytes(open, {0, 0, 0}, {}));
  CloudHeader header;
  header.frame.origin[1] = -500;
  header.tile_ix = {0};
  header.tile_iy = {0};
  header.tile_edge_m = 1000;
  header.voxel_edge_m = 0.1;
  CloudTile tile;
  for (int y = 0; y < 30; ++y) {
    for (int z = 0; z < 62; ++z) {
      for (const float x : {4.0F, 4.1F}) {
        tile.x.push_back(x);
        tile.y.push_back(500 + 0.04F * static_cast<float>(y));
        tile.z.push_back(0.04F * static_cast<float>(z));
      }
    }
  }
  header.points = tile.size();
  tile.surface.assign(tile.size(), 0);
  tile.azimuth.assign(tile.size(), 0);
  tile.area.assign(tile.size(), 0.0016F);
  CloudWriter writer(work_ / "cloud.h5", {"ingest", 1, "{}", "", {}}, header);
  writer.append(tile);
  writer.header().density = 600;
  writer.finish();
  const auto merged = [this](const std::string& options) {
    EXPECT_EQ(run("--truth truth.off" + options), 0) << read("stderr");
    const Json scores = read_json_artefact(work_ / "evaluate/scores.json", artefacts::kScores);
    return scores.at("rooms").at("merged").get<int>();
  };
  EXPECT_EQ(merged(""), 2);
  EXPECT_EQ(merged(" --cloud cloud.h5"), 0);
}

TEST_F(EvaluateProgram, ACloudThatIsNoneIsAnError) {
  write("cloud.h5", "no cloud");
  expect_refused("A02", "--truth truth.off --cloud cloud.h5");
}

TEST_F(EvaluateProgram, ATruthJsonThatIsNoneIsAnErrorOfThatFile) {
  for (const char* boxes : {"3", "[[1, 2]]", "[[[0, 0, 0], [1, 1]]]", R"([[[0, 0, 0], [1, 1, "x"]]])"}) {
    write("truth.json", std::string(R"({"rooms": [], "ignore_boxes": )") + boxes + "}");
    expect_refused("M02", "--truth truth.off --truth-json truth.json");
  }
  const std::string room = R"({"rooms": [{"name": "hall", "floor": 0, "ceiling": 2.5, "center": [1, 1, )";
  for (const std::string& height : {std::string("1e999"), std::string("1e308"), std::string(R"("high")"),
                                    std::string(50'000, '[') + std::string(50'000, ']')}) {
    write("truth.json", room + height + "]}]}");
    expect_refused("M02");
    EXPECT_NE(read("stderr").find("hint:"), std::string::npos);
  }
}

TEST_F(EvaluateProgram, TheSameBytesForOneAndManyThreads) {
  ASSERT_EQ(run("--truth truth.off --threads 1"), 0) << read("stderr");
  const std::string scores = read("evaluate/scores.json");
  const std::string coloured = read("evaluate/distance.ply");
  fs::remove_all(work_ / "evaluate");
  ASSERT_EQ(run("--truth truth.off --threads 4"), 0);
  EXPECT_EQ(read("evaluate/scores.json"), scores);
  EXPECT_EQ(read("evaluate/distance.ply"), coloured);
}

TEST_F(EvaluateProgram, TruthOfTheCellsIsWrittenWhenAskedForAndBelongsToTheCells) {
  const CellComplex complex = three_faces();
  write_cells(work_ / "cells.h5", complex, {});
  const CellsFile cells = read_cells(work_ / "cells.h5");
  const Labels labels = all_solid(complex);
  write_labels(work_ / "labels.h5", labels, cells, {});
  ASSERT_EQ(run("--truth truth.off --cells cells.h5 --labels labels.h5 --cells-out truth_cells.h5"), 0)
      << read("stderr");
  const H5Reader file(work_ / "truth_cells.h5", artefacts::kTruthCells);
  EXPECT_EQ(file.attribute_string("/", "cells_payload_sha256"), cells.payload_sha256);
  const auto sampled = file.read<double>("cell/sampled", {complex.cells()});
  const auto empty = file.read<double>("cell/empty", {complex.cells()});
  for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
    EXPECT_LE(empty[cell], sampled[cell] + 1e-9);
  }
  const std::string bytes = read("truth_cells.h5");
  ASSERT_EQ(
      run("--truth truth.off --cells cells.h5 --labels labels.h5 --cells-out truth_cells.h5 --threads 3"), 0);
  EXPECT_EQ(read("truth_cells.h5"), bytes);
}

TEST_F(EvaluateProgram, CellsOfALevelledScanAreComparedInTheirOwnAxes) {
  CellComplex complex = three_faces();
  const auto truth_of_cells = [&] {
    write_cells(work_ / "cells.h5", complex, {});
    const CellsFile cells = read_cells(work_ / "cells.h5");
    write_labels(work_ / "labels.h5", all_solid(complex), cells, {});
    EXPECT_EQ(run("--truth truth.off --cells cells.h5 --labels labels.h5 --cells-out truth_cells.h5"), 0)
        << read("stderr");
    return H5Reader(work_ / "truth_cells.h5", artefacts::kTruthCells)
        .read<double>("cell/empty", {complex.cells()});
  };
  const std::vector<double> level = truth_of_cells();
  complex.frame.origin[1] = 5000;
  complex.frame.level[0] = 0.08;  // 4.6 degrees
  complex.frame.level[2] = std::sqrt(1 - 0.0064);
  const ScanCoordinates scan(complex.frame);
  TriangleMesh rooms = read_mesh(work_ / "truth.off");
  for (Vec3& vertex : rooms.vertices) vertex = scan.to_scan(vertex);
  write("truth.off", off_text(rooms, {0, 0, 0}));
  write("model.ply", ply_bytes(rooms, {0, 0, 0}, {}));
  const std::vector<double> leaning = truth_of_cells();
  for (std::size_t cell = 0; cell < complex.cells(); ++cell) EXPECT_NEAR(leaning[cell], level[cell], 0.05);
  EXPECT_LT((bounds(read_mesh(work_ / "evaluate/distance.ply")).lo - bounds(rooms).lo).norm(), 1e-3)
      << "what is written lies on the scan";
}

TEST_F(EvaluateProgram, TruthOfTheCellsNeedsCellsAndAClosedModel) {
  EXPECT_EQ(run("--truth truth.off --cells-out truth_cells.h5"), 2);
  EXPECT_NE(read("stderr").find("error[U01] --cells-out"), std::string::npos) << read("stderr");
  EXPECT_FALSE(fs::exists(work_ / "truth_cells.h5"));
  const CellComplex complex = three_faces();
  write_cells(work_ / "cells.h5", complex, {});
  const Labels labels = all_solid(complex);
  write_labels(work_ / "labels.h5", labels, read_cells(work_ / "cells.h5"), {});
  TriangleMesh open = box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  write("model.ply", ply_bytes(open, {0, 0, 0}, {}));
  write("truth_cells.h5", "of an earlier run");
  ASSERT_EQ(run("--truth truth.off --cells cells.h5 --labels labels.h5 --cells-out truth_cells.h5"), 0);
  EXPECT_NE(read("stderr").find("not closed"), std::string::npos) << read("stderr");
  EXPECT_FALSE(fs::exists(work_ / "truth_cells.h5")) << "what is old does not stay";
}

TEST_F(EvaluateProgram, BadMeshesAndDescriptionsAreRefused) {
  write("broken.off", "OFF\n4000000000 4000000000 0\n0 0 0\n");
  TriangleMesh open = box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  write("open.off", off_text(open, {0, 0, 0}));
  write("rooms.json", R"({"rooms": [{"name": "kitchen"}]})");
  fs::create_directory(work_ / "folder.off");
  expect_refused("M01", "--truth folder.off");
  expect_refused("M02", "--truth broken.off");
  expect_refused("M02", "--truth truth.off --truth-json rooms.json");
  expect_refused("M03", "--truth open.off");
}

TEST_F(EvaluateProgram, ATruthInMillimetresOrElsewhereIsRefusedAndTheUnitNamed) {
  TriangleMesh truth = box({0, 0, 0}, {8, 3, 2.5});
  write("elsewhere.off", off_text(truth, {500000, 5900000, 40}));
  for (Vec3& p : truth.vertices) p *= 1000;
  write("mm.off", off_text(truth, {0, 0, 0}));
  expect_refused("M04", "--truth mm.off");
  EXPECT_NE(read("stderr").find("millimetres"), std::string::npos) << read("stderr");
  expect_refused("M04", "--truth elsewhere.off");
  EXPECT_NE(read("stderr").find("do not meet"), std::string::npos) << read("stderr");
}

TEST_F(EvaluateProgram, AFarVertexIsNamed) {
  std::string truth = read("truth.off");
  const std::size_t first = truth.find('\n', truth.find('\n') + 1) + 1;
  for (const char* far : {"1e6", "-1e9", "1e308"}) {
    write("far.off", std::string(truth).replace(first, truth.find(' ', first) - first, far));
    expect_refused("M02", "--truth far.off");
    EXPECT_NE(read("stderr").find("vertex 0"), std::string::npos) << read("stderr");
  }
}

TEST_F(EvaluateProgram, ASpacingThatAsksForTooManySamplesIsRefused) {
  EXPECT_EQ(run("--truth truth.off --set sample_spacing_m=0.001"), 4);
  EXPECT_NE(read("stderr").find("error[N07] sample_spacing_m"), std::string::npos) << read("stderr");
  EXPECT_EQ(run("--truth truth.off --set column_spacing_m=0.001"), 4);
  EXPECT_NE(read("stderr").find("error[N07] column_spacing_m"), std::string::npos) << read("stderr");
}

}  // namespace
}  // namespace roomcut::evaluate

// SPDX-License-Identifier: GPL-3.0-or-later
// The program itself, on files: what it writes, and what it refuses.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/artefact/json.h"
#include "common/mesh/mesh_io.h"
#include "tests/unit/mesh/shapes.h"

namespace roomcut {
namespace {

namespace fs = std::filesystem;
using test::append;
using test::box;

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

TEST_F(EvaluateProgram, TheSameBytesForOneAndManyThreads) {
  ASSERT_EQ(run("--truth truth.off --threads 1"), 0) << read("stderr");
  const std::string scores = read("evaluate/scores.json");
  const std::string coloured = read("evaluate/distance.ply");
  fs::remove_all(work_ / "evaluate");
  ASSERT_EQ(run("--truth truth.off --threads 4"), 0);
  EXPECT_EQ(read("evaluate/scores.json"), scores);
  EXPECT_EQ(read("evaluate/distance.ply"), coloured);
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

}  // namespace
}  // namespace roomcut

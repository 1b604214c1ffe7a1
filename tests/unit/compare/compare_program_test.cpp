// SPDX-License-Identifier: GPL-3.0-or-later
// The program itself, on the files of two runs that are not what their writers wrote.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/artefact/json_values.h"
#include "common/cloud/cloud_io.h"

namespace roomcut::compare {
namespace {

namespace fs = std::filesystem;

class CompareProgram : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(work_);
    for (const char* run : {"a", "b"}) {
      fs::create_directories(work_ / run / "10_ingest");
      fs::create_directories(work_ / run / "logs");
      CloudHeader header;
      header.tile_edge_m = 6.4;
      header.voxel_edge_m = 0.05;
      CloudWriter(work_ / run / "10_ingest/cloud.h5", {"ingest", 1, "{}", "", {}}, header).finish();
      write_summary(run, {{"storeys", Json::array()}, {"rooms", Json::array()}});
      write(std::string(run) + "/logs/ingest.json", R"({"chosen": [{"parameter": "x", "value": 1}]})");
    }
  }
  void TearDown() override { fs::remove_all(work_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(work_ / name, std::ios::binary) << text;
  }
  void write_summary(const std::string& run, const Json& content) const {
    write_json_artefact(work_ / run / "summary.json", artefacts::kSummary, {}, {}, content);
  }
  int run() const {
    const std::string command = "cd '" + work_.string() + "' && '" + ROOMCUT_BIN_DIR +
                                "/compare' --work . --a a --b b > stdout 2> stderr";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  void expect_refused(const std::string& file) const {
    EXPECT_EQ(run(), 3);
    std::ifstream stream(work_ / "stderr");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(text.find("error[A02]"), std::string::npos) << text;
    EXPECT_NE(text.find(file), std::string::npos) << text;
    EXPECT_NE(text.find("hint:"), std::string::npos) << text;
    EXPECT_EQ(text.find("json.exception"), std::string::npos) << text;
  }

  fs::path work_ = fs::path(testing::TempDir()) / "roomcut compare ü";
};

TEST_F(CompareProgram, TakesWhatIsWhole) {
  EXPECT_EQ(run(), 0);
}

TEST_F(CompareProgram, ADamagedLogIsAnErrorOfThatFile) {
  for (const std::string& text :
       {std::string("{"), std::string("[1]"), std::string(R"({"chosen": 5})"),
        std::string(R"({"chosen": [{"parameter": 7, "value": 1}]})"), std::string(R"({"chosen": [1e999]})"),
        std::string(R"({"x": )") + std::string(50'000, '[') + std::string(50'000, ']') + "}"}) {
    write("b/logs/ingest.json", text);
    expect_refused("logs/ingest.json");
  }
}

TEST_F(CompareProgram, ASummaryWithOtherTypesIsAnErrorOfThatFile) {
  write_summary("a", {{"storeys", 3}, {"rooms", Json::array()}});
  expect_refused("a/summary.json");
  write_summary("a", {{"storeys", Json::array()}, {"rooms", {{{"storey", "first"}}}}});
  expect_refused("a/summary.json");
  write_summary("a", {{"storeys", Json::array()}, {"rooms", {{{"centre_m", {1e300, 0}}}}}});
  expect_refused("a/summary.json");
}

}  // namespace
}  // namespace roomcut::compare

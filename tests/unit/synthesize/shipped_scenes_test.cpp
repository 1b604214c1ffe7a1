// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/artefact/json_values.h"
#include "common/artefact/sha256.h"
#include "common/mesh/mesh_check.h"
#include "stages/tools/synthesize/scene_json.h"
#include "stages/tools/synthesize/synthesize_io.h"

namespace roomcut::synthesize {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(ROOMCUT_SOURCE_DIR "/tests/data/scenes")) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, HasAValidTruthThatFitsItsTables) {
  const Scene scene = read_scene(ROOMCUT_SOURCE_DIR "/tests/data/scenes/" + GetParam() + ".json");
  EXPECT_EQ(scene.name, GetParam());
  const Building building = place(scene);
  const TriangleMesh truth = make_truth(scene, building);
  const MeshCheck check = check_mesh(truth);
  EXPECT_TRUE(check.valid()) << describe_faults(check);
  const auto tables = truth_json(scene, building, truth, 0);
  double rooms = 0;
  for (const auto& room : tables["rooms"]) rooms += room["volume"].get<double>();
  EXPECT_EQ(tables["rooms"].size(), scene.rooms.size());
  EXPECT_GE(check.volume_m3, rooms - 1e-4);  // rooms, and doorways and shafts between them
  EXPECT_LT(check.volume_m3, rooms * 1.02);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(shipped()),
                         [](const auto& scene) { return scene.param; });

TEST(ShippedScenes, AreAtLeastEight) {
  EXPECT_GE(shipped().size(), 8U);
}

std::string scan_digest(const Scene& scene, int threads, std::uint64_t* points) {
  const fs::path path = fs::path(testing::TempDir()) / ("roomcut_scan_" + std::to_string(threads) + ".ply");
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  const Building building = place(scene);
  const TriangleMesh truth = make_truth(scene, building);
  const Surfaces surfaces(scene, building, truth);
  const auto source = make_source(scene, building, surfaces);
  *points = write_scan(path, scene, *source, {}, threads, [](std::uint64_t) {});
  std::string digest = sha256_of_file(path);
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::uint64_t promised = 0;
  while (std::getline(file, line) && line != "end_header") {
    if (line.rfind("element vertex ", 0) == 0) promised = std::stoull(line.substr(15));
  }
  EXPECT_EQ(promised, *points);
  EXPECT_EQ(fs::file_size(path), static_cast<std::uint64_t>(file.tellg()) + 12 * *points);
  fs::remove(path);
  return digest;
}

TEST(ShippedScenes, GiveTheSameBytesForAnyNumberOfThreads) {
  for (const char* name : {"one_room", "thin_walls_clutter"}) {
    Scene scene = read_scene(std::string(ROOMCUT_SOURCE_DIR "/tests/data/scenes/") + name + ".json");
    scene.sampling.points = 150000;
    std::uint64_t points = 0;
    const std::string one = scan_digest(scene, 1, &points);
    EXPECT_NEAR(static_cast<double>(points), 150000, 3000);
    EXPECT_EQ(one, scan_digest(scene, 2, &points));
    EXPECT_EQ(one, scan_digest(scene, 8, &points));
  }
}

}  // namespace
}  // namespace roomcut::synthesize

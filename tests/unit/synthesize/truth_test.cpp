// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/truth.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "common/errors/error.h"
#include "common/mesh/mesh_check.h"
#include "tests/unit/synthesize/test_scenes.h"

namespace roomcut::synthesize {
using namespace roomcut::test;

namespace {

using nlohmann::json;

TriangleMesh truth_of(const Scene& scene) {
  return make_truth(scene, place(scene));
}

std::string complaint(const json& scene) {
  try {
    truth_of(scene_from_json(scene, "s"));
  } catch (const StageError& error) {
    return error.problems().front().what;
  }
  return "";
}

TEST(Truth, ABoxHasTwelveTrianglesAndItsVolume) {
  const TriangleMesh mesh = truth_of(test::box_scene());
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NEAR(volume(mesh), 30, 1e-12);
  EXPECT_TRUE(check_mesh(mesh).valid()) << describe_faults(check_mesh(mesh));
}

TEST(Truth, ADoorwayJoinsTwoRoomsAndAddsExactlyItsVolume) {
  const TriangleMesh mesh = truth_of(scene_from_json(test::two_rooms_json(), "s"));
  const MeshCheck check = check_mesh(mesh);
  EXPECT_TRUE(check.valid()) << describe_faults(check);
  EXPECT_EQ(check.components, 1);
  EXPECT_NEAR(check.volume_m3, 4 * 3 * 2.5 + 2 * 3 * 2.4 + 0.8 * 0.2 * 2.0, 1e-12);
}

TEST(Truth, AnObliqueDoorwayEndsOnBothWallPlanes) {
  json scene = test::two_rooms_json();
  scene["storeys"][0]["rooms"][1]["polygon"] = json::parse("[[4.2,0],[6.2,0],[6.2,3],[4.5,3]]");
  const TriangleMesh mesh = truth_of(scene_from_json(scene, "s"));
  EXPECT_TRUE(check_mesh(mesh).valid());
  const double depth = 0.2 + 0.3 * 1.5 / 3;  // of the doorway's middle
  EXPECT_NEAR(volume(mesh), 30 + (2 + 1.7) / 2 * 3 * 2.4 + 0.8 * depth * 2.0, 1e-9);
}

TEST(Truth, AShaftJoinsTwoStoreys) {
  const Scene scene = scene_from_json(json::parse(R"({"storeys": [
      {"floor": 0, "ceiling": 2.5, "rooms": [{"name": "a", "polygon": [[0,0],[4,0],[4,3],[0,3]]}]},
      {"floor": 2.8, "ceiling": 5, "rooms": [{"name": "b", "polygon": [[1,0.5],[5,0.5],[5,3],[1,3]]}]}],
      "shafts": [{"between": ["a","b"], "polygon": [[2,1],[3,1],[3,2],[2,2]]}]})"),
                                      "s");
  const MeshCheck check = check_mesh(truth_of(scene));
  EXPECT_TRUE(check.valid()) << describe_faults(check);
  EXPECT_EQ(check.components, 1);
  EXPECT_NEAR(check.volume_m3, 12 * 2.5 + 4 * 2.5 * 2.2 + 0.3, 1e-12);
}

TEST(Truth, WallsAreSplitOnlyWhereAnotherSurfaceHasACorner) {
  // The second storey's plan crosses the first one's; nothing of it may show in the first one's mesh.
  const Scene scene = scene_from_json(json::parse(R"({"storeys": [
      {"floor": 0, "ceiling": 2.5, "rooms": [{"name": "a", "polygon": [[0,0],[4,0],[4,3],[0,3]]}]},
      {"floor": 2.8, "ceiling": 5, "rooms": [{"name": "b", "polygon": [[2,-1],[6,1],[4,5],[1,2]]}]}]})"),
                                      "s");
  const TriangleMesh mesh = truth_of(scene);
  EXPECT_TRUE(check_mesh(mesh).valid());
  std::set<double> heights;
  std::size_t upright_edges_low = 0;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vec3& a = mesh.vertices[t[i]];
      const Vec3& b = mesh.vertices[t[(i + 1) % 3]];
      heights.insert(a.z());
      if (a.head<2>() == b.head<2>() && a.z() < b.z() && b.z() <= 2.5) ++upright_edges_low;
    }
  }
  EXPECT_EQ(heights, (std::set<double>{0, 2.5, 2.8, 5}));
  EXPECT_GE(upright_edges_low, 4U);
  for (const Vec3& v : mesh.vertices)
    EXPECT_EQ(v.z() == 0 || v.z() == 2.5 || v.z() == 2.8 || v.z() == 5, true);
}

TEST(Truth, RoomsThatOverlapOrTouchAreRefused) {
  json scene = test::two_rooms_json();
  scene.erase("doors");
  json& other = scene["storeys"][0]["rooms"][1]["polygon"];
  other = json::parse("[[3.9,0],[6,0],[6,3],[3.9,3]]");
  EXPECT_NE(complaint(scene).find("overlap"), std::string::npos);
  other = json::parse("[[4,0],[6,0],[6,3],[4,3]]");
  EXPECT_NE(complaint(scene).find("touch without a wall"), std::string::npos);
  other = json::parse("[[4,3],[6,3],[6,5],[4,5]]");
  EXPECT_NE(complaint(scene).find("2-manifold"), std::string::npos);
}

TEST(Truth, StackedRoomsWithoutASlabAreRefused) {
  EXPECT_NE(complaint(json::parse(R"({"storeys": [
      {"floor": 0, "ceiling": 2.5, "rooms": [{"name": "a", "polygon": [[0,0],[4,0],[4,3],[0,3]]}]},
      {"floor": 2.5, "ceiling": 5, "rooms": [{"name": "b", "polygon": [[0,0],[4,0],[4,3],[0,3]]}]}]})"))
                .find("without a slab"),
            std::string::npos);
}

TEST(Truth, DefectsAreFound) {
  TriangleMesh mesh = truth_of(test::box_scene());
  EXPECT_EQ(find_defect(mesh), "");
  TriangleMesh turned = mesh;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_NE(find_defect(turned), "");
  mesh.triangles.pop_back();
  EXPECT_NE(find_defect(mesh).find("open edge"), std::string::npos);
}

}  // namespace
}  // namespace roomcut::synthesize

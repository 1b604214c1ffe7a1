// SPDX-License-Identifier: GPL-3.0-or-later
// The program itself, on files: what it writes, and what it refuses.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"
#include "common/cells/cells_io.h"
#include "common/cells/surfaces_io.h"
#include "common/geometry/scan_coordinates.h"
#include "common/mesh/mesh_check.h"
#include "common/mesh/mesh_io.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut::extract {
namespace {

namespace fs = std::filesystem;

class ExtractProgram : public testing::Test {
 protected:
  void SetUp() override {
    work_ = fs::path(testing::TempDir()) / "roomcut extract ü";
    fs::remove_all(work_);
    fs::create_directories(work_ / "90_final");
    frame_.origin[0] = 1000;
    frame_.origin[2] = 50;
  }
  void TearDown() override { fs::remove_all(work_); }

  // A block of 2 x 2 cells inside a rim of solid ones; `pattern` says which of them are empty.
  void write_inputs(const std::function<bool(const Vec2&, double)>& empty) const {
    CellComplex complex = test::grid_complex({0, 1, 2, 3, 4}, {0, 1, 2, 3, 4}, {0, 1, 2, 3});
    complex.frame = frame_;
    const fs::path folder = work_ / "90_final";
    write_cells(folder / "cells.h5", complex, {});
    const CellsFile cells = read_cells(folder / "cells.h5");
    const std::size_t walls = complex.edges.size() * complex.layers();
    const std::size_t levels = complex.faces() * complex.levels.size();
    FaceWeights weights;
    for (auto* values : {&weights.wall_omega, &weights.wall_left, &weights.wall_right})
      values->assign(walls, 0);
    for (auto* values : {&weights.level_omega, &weights.level_floor, &weights.level_ceiling})
      values->assign(levels, 0);
    weights.wall_points.assign(walls, 0);
    weights.level_points.assign(levels, 0);
    weights.cell_points.assign(complex.cells(), 0);
    weights.cell_slope.assign(complex.cells(), 0);
    write_weights(folder / "weights.h5", weights, cells, {});
    DataTerms terms;
    terms.reset(complex);
    write_data_terms(folder / "data_terms.h5", terms, cells, {});
    write_labels(folder / "labels.h5", test::label_where(complex, empty), cells, {});
  }

  int run() const {
    const std::string command = std::string("'") + ROOMCUT_BIN_DIR + "/extract' -q --work '" +
                                work_.string() + "' 2> '" + (work_ / "stderr").string() + "'";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  std::string errors() const {
    std::ifstream file(work_ / "stderr");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  fs::path work_;
  Frame frame_;
};

bool in_the_middle(const Vec2& p, double z) {
  return p.x() > 1 && p.x() < 3 && p.y() > 1 && p.y() < 3 && z > 1 && z < 2;
}

TEST_F(ExtractProgram, WritesAModelThatLiesOnTheScanAndTheSameBytesAgain) {
  write_inputs(in_the_middle);
  ASSERT_EQ(run(), 0) << errors();
  const TriangleMesh model = read_mesh(work_ / "model.ply");
  EXPECT_TRUE(check_mesh(model).valid());
  EXPECT_EQ(model.triangles.size(), 12U);
  EXPECT_EQ(model.kind.size(), 12U);
  EXPECT_EQ(bounds(model).lo, Vec3(1001, 1, 51));
  const TriangleMesh obj = read_mesh(work_ / "model.obj");
  EXPECT_EQ(bounds(obj).hi, Vec3(1003, 3, 52));
  const Json summary = read_json_artefact(work_ / "summary.json", artefacts::kSummary);
  EXPECT_DOUBLE_EQ(summary.at("totals").at("volume_m3").get<double>(), 4);
  EXPECT_DOUBLE_EQ(summary.at("storeys").at(0).at("floor_z_m").get<double>(), 51);
  const std::string first = ply_bytes(model, {0, 0, 0}, {});
  fs::remove(work_ / "model.ply");
  ASSERT_EQ(run(), 0);
  EXPECT_EQ(ply_bytes(read_mesh(work_ / "model.ply"), {0, 0, 0}, {}), first);
}

TEST_F(ExtractProgram, PutsFloorsAndCeilingsAtTheirSurfacesAndRefusesThoseOfOtherCells) {
  write_inputs(in_the_middle);
  CellsFile cells = read_cells(work_ / "90_final/cells.h5");
  LevelSurfaces surfaces;
  surfaces.surfaces.resize(1);
  surfaces.surfaces[0].gradient = Vec2(0.1, 0);
  surfaces.surfaces[0].c = 1.8;  // 2 in the middle, at x = 2
  surfaces.of_face.assign(cells.complex.levels.size() * cells.complex.faces(), -1);
  for (std::size_t f = 0; f < cells.complex.faces(); ++f) {
    surfaces.of_face[cells.complex.level_face(f, 2)] = 0;
  }
  const fs::path file = work_ / "92_fit_surfaces/surfaces.h5";
  write_surfaces(file, surfaces, cells, {});
  ASSERT_EQ(run(), 0) << errors();
  EXPECT_NEAR(bounds(read_mesh(work_ / "model.ply")).hi.z(), 52.1, 1e-9);
  const Json room = read_json_artefact(work_ / "summary.json", artefacts::kSummary).at("rooms").at(0);
  EXPECT_NEAR(room.at("lowest_ceiling_z_m").get<double>(), 51.9, 1e-9);
  EXPECT_NEAR(room.at("ceiling_z_m").get<double>(), 52, 1e-9);
  EXPECT_NEAR(room.at("highest_ceiling_z_m").get<double>(), 52.1, 1e-9);
  EXPECT_NEAR(room.at("volume_m3").get<double>(), 4, 1e-9);
  cells.payload_sha256 = "another";
  write_surfaces(file, surfaces, cells, {});
  EXPECT_EQ(run(), 3);
  EXPECT_NE(errors().find("error[A05]"), std::string::npos) << errors();
}

TEST_F(ExtractProgram, ListsAnUnknownSpaceInTheSummaryAndItsCellsInTheRooms) {
  write_inputs(in_the_middle);
  const fs::path folder = work_ / "90_final";
  const CellsFile cells = read_cells(folder / "cells.h5");
  Labels labels = read_labels(folder / "labels.h5", cells);
  const std::size_t unknown = cells.complex.cell(0, 1);  // a corner of the plan, 1 m^3
  labels.label[unknown] = Label::kUnknown;
  write_labels(folder / "labels.h5", labels, cells, {});
  ASSERT_EQ(run(), 0) << errors();
  const Json summary = read_json_artefact(work_ / "summary.json", artefacts::kSummary);
  ASSERT_EQ(summary.at("unknown_spaces").size(), 1U);
  const Json& space = summary.at("unknown_spaces").at(0);
  const Vec2 middle = cells.complex.centroid(0);
  EXPECT_DOUBLE_EQ(space.at("volume_m3").get<double>(), 1);
  EXPECT_NEAR(space.at("place_m").at(0).get<double>(), 1000 + middle.x(), 1e-9)
      << "in the scan's coordinates";
  EXPECT_NEAR(space.at("place_m").at(2).get<double>(), 51, 1e-9);
  EXPECT_NE(space.at("to_know").get<std::string>().find("scan from inside it"), std::string::npos);
  EXPECT_DOUBLE_EQ(summary.at("totals").at("unknown_m3").get<double>(), 1);
  EXPECT_DOUBLE_EQ(summary.at("totals").at("volume_m3").get<double>(), 4) << "no part of the model";
  const CellRooms rooms = read_rooms(work_ / "rooms.h5", cells);
  for (std::size_t cell = 0; cell < cells.complex.cells(); ++cell) {
    EXPECT_EQ(rooms.unknown_space[cell], cell == unknown ? 0 : -1);
  }
}

TEST_F(ExtractProgram, OfALevelledScanModelAndSummaryLieOnTheScan) {
  frame_.level[0] = 0.06;
  frame_.level[2] = std::sqrt(1 - 0.0036);
  frame_.crs = "PROJCS[\"x\",\n UNIT[\"metre\",1]]";
  write_inputs(in_the_middle);
  ASSERT_EQ(run(), 0) << errors();
  const ScanCoordinates scan(frame_);
  const TriangleMesh model = read_mesh(work_ / "model.ply");
  for (const Vec3& vertex : model.vertices) {
    const Vec3 local = scan.to_local(vertex);
    EXPECT_LT((local - local.array().round().matrix()).norm(), 1e-9) << "a corner of the cells";
  }
  const Json summary = read_json_artefact(work_ / "summary.json", artefacts::kSummary);
  const Vec3 floor = scan.to_scan(Vec3(2, 2, 1));
  for (const Json& space : {summary.at("storeys").at(0), summary.at("rooms").at(0)}) {
    EXPECT_NEAR(space.at("centre_m").at(0).get<double>(), floor.x(), 1e-9);
    EXPECT_NEAR(space.at("floor_z_m").get<double>(), floor.z(), 1e-9);
    for (const char* ceiling : {"ceiling_z_m", "lowest_ceiling_z_m", "highest_ceiling_z_m"}) {
      EXPECT_NEAR(space.at(ceiling).get<double>(), scan.to_scan(Vec3(2, 2, 2)).z(), 1e-9);
    }
    EXPECT_NEAR(space.at("height_m").get<double>(), 1, 1e-9);
  }
  EXPECT_EQ(summary.at("frame").at("crs"), frame_.crs);
  for (const char* file : {"model.ply", "model.obj"}) {
    EXPECT_NE(read_text_file(work_ / file).find(" coordinate system: PROJCS[\"x\", UNIT[\"metre\",1]]\n"),
              std::string::npos)
        << file;
  }
}

TEST_F(ExtractProgram, SurfacesThatTouchAreN06AndTheMeshIsKeptAsEvidence) {
  write_inputs(in_the_middle);
  ASSERT_EQ(run(), 0) << errors();
  write_inputs([](const Vec2& p, double z) { return in_the_middle(p, z) && (p.x() < 2) == (p.y() < 2); });
  EXPECT_EQ(run(), 4);
  EXPECT_NE(errors().find("error[N06]"), std::string::npos) << errors();
  EXPECT_TRUE(fs::exists(work_ / "model.rejected.ply"));
  EXPECT_EQ(read_mesh(work_ / "model.ply").triangles.size(), 12U) << "the model of before is not lost";
  write_inputs(in_the_middle);
  ASSERT_EQ(run(), 0) << errors();
  EXPECT_FALSE(fs::exists(work_ / "model.rejected.ply"));
}

TEST_F(ExtractProgram, NoEmptyCellIsN05AndLeavesNothing) {
  write_inputs([](const Vec2&, double) { return false; });
  EXPECT_EQ(run(), 4);
  EXPECT_NE(errors().find("error[N05]"), std::string::npos) << errors();
  EXPECT_FALSE(fs::exists(work_ / "model.ply"));
}

TEST_F(ExtractProgram, MissingLabelsAreA01) {
  write_inputs(in_the_middle);
  fs::remove(work_ / "90_final/labels.h5");
  EXPECT_EQ(run(), 3);
  EXPECT_NE(errors().find("error[A01]"), std::string::npos) << errors();
}

}  // namespace
}  // namespace roomcut::extract

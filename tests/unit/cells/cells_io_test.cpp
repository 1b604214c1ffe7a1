// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/cells_io.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include "common/errors/codes.h"
#include "tests/unit/cells/three_faces.h"

namespace roomcut {
namespace {

class CellsIo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("roomcut_cells_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    cells_.complex = three_faces();
    cells_.complex.frame.origin[1] = 5.4e6;
    write_cells(folder_ / "cells.h5", cells_.complex, provenance_);
    cells_ = read_cells(folder_ / "cells.h5");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string code_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const StageError& error) {
      return error.problems()[0].code.id;
    }
    return "none";
  }

  Labels labels() const {
    Labels labels;
    labels.label = {0, 1, 2, 0, 1, 0};
    labels.margin_m3 = {1, 2, 3, 4, 5, -0.5F};
    labels.unobserved = {0, 0, 1, 0, 0, 1};
    labels.energy_m3 = 1.75;
    labels.data_m3 = 1.5;
    labels.boundary_m3 = 0.25;
    labels.repair_flips = 3;
    return labels;
  }

  CellRooms rooms() const {
    return {{-1, 0, -1, -1, 1, -1}, {-1, 1, -1, -1, 0, -1}, {-1, -1, 0, -1, -1, -1}};
  }

  DataTerms terms() const {
    DataTerms terms;
    terms.reset(cells_.complex);
    terms.constant = 1.1;
    terms.weights_source = "a search";
    terms.features = {{"open", -3, "not closed", {0, 0, 0.5F, 0, 0, 0}},
                      {"sky", -0.8, "outdoors", {1, 2, 3, 4, 5, 6}}};
    for (auto* values : {&terms.thin, &terms.line_of_sight, &terms.closed}) {
      values->assign(6, 0.25F);
    }
    terms.line_of_sight[4] = 0.5F;
    terms.closed[3] = 0.75F;
    terms.wall_implied.front() = 0.75F;
    terms.level_implied.back() = 1.0F;
    terms.vertical[2] = -1;
    terms.winding[1] = -3;
    terms.surface_m2[0] = -12.5F;
    terms.d_empty = {0, 1, 2, 3, 4, 5};
    terms.d_solid = {5, 4, 3, 2, 1, 0};
    return terms;
  }

  FaceWeights weights() const {
    FaceWeights weights;
    weights.wall_omega.assign(20, 0.5F);
    weights.stations = {Vec3(1, 2, 3)};
    weights.wall_left.assign(20, 1.0F);
    weights.wall_right.assign(20, 0.0F);
    weights.wall_points.assign(20, 7);
    weights.level_omega.assign(9, 0.25F);
    weights.level_floor.assign(9, 0.125F);
    weights.level_ceiling.assign(9, 0.75F);
    weights.level_points.assign(9, 4000000000U);
    weights.cell_points.assign(6, 9);
    weights.cell_slope.assign(6, 0.375F);
    return weights;
  }

  std::filesystem::path folder_;
  Provenance provenance_{"test", 1, "{}", "", {}};
  CellsFile cells_;
};

TEST_F(CellsIo, ACellComplexComesBackAsItWas) {
  const CellComplex expected = three_faces();
  const CellComplex& complex = cells_.complex;
  EXPECT_EQ(complex.frame.origin[1], 5.4e6);
  EXPECT_EQ(complex.levels, expected.levels);
  EXPECT_EQ(complex.vertices, expected.vertices);
  EXPECT_EQ(complex.face_offset, expected.face_offset);
  EXPECT_EQ(complex.face_vertex, expected.face_vertex);
  EXPECT_EQ(complex.face_edge, expected.face_edge);
  ASSERT_EQ(complex.lines.size(), 2U);
  EXPECT_EQ(complex.lines[1].wall_id, "büro 2");
  EXPECT_EQ(complex.lines[1].line.theta, expected.lines[1].line.theta);
  EXPECT_EQ(complex.lines[1].t0, -4);
  EXPECT_EQ(complex.lines[1].layers, (std::vector<std::int32_t>{1}));
  EXPECT_TRUE(complex.lines[0].layers.empty());
}

TEST_F(CellsIo, NumbersThatNoBuildingHasAndTextsThatAreNoneAreDamage) {
  const auto code = [&](const std::function<void(CellComplex&)>& spoil) {
    CellComplex wrong = cells_.complex;
    spoil(wrong);
    write_cells(folder_ / "wrong.h5", wrong, provenance_);
    return code_of([&] { read_cells(folder_ / "wrong.h5"); });
  };
  EXPECT_EQ(code([](CellComplex&) {}), "none");
  EXPECT_EQ(code([](CellComplex& c) { c.lines[0].wall_id = "w\xff"; }), "A02");
  EXPECT_EQ(code([](CellComplex& c) { c.lines[0].t1 = 1e308; }), "A02");
  EXPECT_EQ(code([](CellComplex& c) { c.levels.back() = 1e300; }), "A02");
  EXPECT_EQ(code([](CellComplex& c) { c.face_vertex[0] = 1'000'000; }), "A02");
  EXPECT_EQ(code([](CellComplex& c) { c.face_offset[1] = -5; }), "A02");
}

TEST_F(CellsIo, OneChangedHeightIsNotBelieved) {
  std::string bytes = [&] {
    std::ifstream file(folder_ / "cells.h5", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  const double height = cells_.complex.levels.back();
  const std::string held(reinterpret_cast<const char*>(&height), sizeof(height));
  const double raised = height + 1;
  const std::size_t at = bytes.find(held);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, sizeof(raised), reinterpret_cast<const char*>(&raised), sizeof(raised));
  std::ofstream(folder_ / "raised.h5", std::ios::binary) << bytes;
  EXPECT_EQ(code_of([&] { read_cells(folder_ / "raised.h5"); }), "A02");
}

TEST_F(CellsIo, EqualContentGivesEqualBytesAndIsNotNews) {
  const auto bytes = [&](const char* name) {
    std::ifstream file(folder_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_FALSE(write_cells(folder_ / "cells.h5", cells_.complex, provenance_));
  EXPECT_TRUE(write_cells(folder_ / "again.h5", cells_.complex, provenance_));
  EXPECT_EQ(bytes("cells.h5"), bytes("again.h5"));
  EXPECT_FALSE(bytes("cells.h5").empty());
}

TEST_F(CellsIo, ABrokenComplexIsRefusedOnReading) {
  cells_.complex.vertices[7].x() += 0.1;
  write_cells(folder_ / "broken.h5", cells_.complex, provenance_);
  EXPECT_EQ(code_of([&] { read_cells(folder_ / "broken.h5"); }), errors::kArtefactDamaged.id);
  EXPECT_EQ(code_of([&] { read_cells(folder_ / "none.h5"); }), errors::kArtefactMissing.id);
}

TEST_F(CellsIo, EvidenceAndLabelsComeBackAsTheyWere) {
  write_weights(folder_ / "weights.h5", weights(), cells_, provenance_);
  const FaceWeights w = read_weights(folder_ / "weights.h5", cells_);
  EXPECT_EQ(w.wall_omega, weights().wall_omega);
  EXPECT_EQ(w.wall_left, weights().wall_left);
  EXPECT_EQ(w.wall_right, weights().wall_right);
  EXPECT_EQ(w.level_floor, weights().level_floor);
  EXPECT_EQ(w.level_ceiling, weights().level_ceiling);
  EXPECT_EQ(w.level_points, weights().level_points);
  EXPECT_EQ(w.cell_points, weights().cell_points);
  EXPECT_EQ(w.cell_slope, weights().cell_slope);
  ASSERT_EQ(w.stations.size(), 1U);
  EXPECT_EQ(w.stations[0], Vec3(1, 2, 3));

  write_data_terms(folder_ / "terms.h5", terms(), cells_, provenance_);
  const DataTerms t = read_data_terms(folder_ / "terms.h5", cells_);
  EXPECT_EQ(t.vertical, terms().vertical);
  EXPECT_EQ(t.winding, terms().winding);
  EXPECT_EQ(t.surface_m2, terms().surface_m2);
  EXPECT_EQ(t.thin, terms().thin);
  EXPECT_EQ(t.closed, terms().closed);
  ASSERT_EQ(t.features.size(), 2U);
  for (std::size_t i = 0; i < t.features.size(); ++i) {
    EXPECT_EQ(t.features[i].name, terms().features[i].name);
    EXPECT_EQ(t.features[i].weight, terms().features[i].weight);
    EXPECT_EQ(t.features[i].meaning, terms().features[i].meaning);
    EXPECT_EQ(t.features[i].value, terms().features[i].value);
  }
  EXPECT_EQ(t.constant, 1.1);
  EXPECT_EQ(t.weights_source, "a search");
  EXPECT_EQ(t.line_of_sight, terms().line_of_sight);
  EXPECT_EQ(t.wall_implied, terms().wall_implied);
  EXPECT_EQ(t.level_implied, terms().level_implied);
  EXPECT_EQ(t.d_empty, terms().d_empty);
  EXPECT_EQ(t.d_solid, terms().d_solid);

  write_labels(folder_ / "labels.h5", labels(), cells_, provenance_);
  const Labels l = read_labels(folder_ / "labels.h5", cells_);
  EXPECT_EQ(l.label, labels().label);
  EXPECT_EQ(l.margin_m3, labels().margin_m3);
  EXPECT_EQ(l.unobserved, labels().unobserved);
  EXPECT_EQ(l.energy_m3, 1.75);
  EXPECT_EQ(l.boundary_m3, 0.25);
  EXPECT_EQ(l.repair_flips, 3);

  write_rooms(folder_ / "rooms.h5", rooms(), cells_, provenance_);
  const CellRooms r = read_rooms(folder_ / "rooms.h5", cells_);
  EXPECT_EQ(r.storey, rooms().storey);
  EXPECT_EQ(r.room, rooms().room);
  EXPECT_EQ(r.unknown_space, rooms().unknown_space);
}

TEST_F(CellsIo, FilesOfOtherCellsAreRefused) {
  write_weights(folder_ / "weights.h5", weights(), cells_, provenance_);
  write_labels(folder_ / "labels.h5", labels(), cells_, provenance_);
  CellsFile other = cells_;
  other.complex.levels[2] = 3.1;
  write_cells(folder_ / "other.h5", other.complex, provenance_);
  other = read_cells(folder_ / "other.h5");
  EXPECT_EQ(code_of([&] { read_weights(folder_ / "weights.h5", other); }), errors::kArtefactMismatch.id);
  EXPECT_EQ(code_of([&] { read_labels(folder_ / "labels.h5", other); }), errors::kArtefactMismatch.id);
  write_rooms(folder_ / "rooms.h5", rooms(), cells_, provenance_);
  EXPECT_EQ(code_of([&] { read_rooms(folder_ / "rooms.h5", other); }), errors::kArtefactMismatch.id);
  EXPECT_EQ(code_of([&] { read_labels(folder_ / "weights.h5", cells_); }), errors::kArtefactType.id);
}

TEST_F(CellsIo, ValuesOutOfRangeAreRefusedAndWrongSizesAreABug) {
  FaceWeights bad = weights();
  bad.wall_omega[3] = 1.5F;
  write_weights(folder_ / "weights.h5", bad, cells_, provenance_);
  EXPECT_EQ(code_of([&] { read_weights(folder_ / "weights.h5", cells_); }), errors::kArtefactDamaged.id);
  DataTerms nan = terms();
  nan.winding[0] = std::numeric_limits<float>::quiet_NaN();
  write_data_terms(folder_ / "terms.h5", nan, cells_, provenance_);
  EXPECT_EQ(code_of([&] { read_data_terms(folder_ / "terms.h5", cells_); }), errors::kArtefactDamaged.id);
  Labels three = labels();
  three.label[0] = 3;
  write_labels(folder_ / "labels.h5", three, cells_, provenance_);
  EXPECT_EQ(code_of([&] { read_labels(folder_ / "labels.h5", cells_); }), errors::kArtefactDamaged.id);
  three.label.pop_back();
  EXPECT_THROW(write_labels(folder_ / "labels.h5", three, cells_, provenance_), std::logic_error);
  CellRooms below = rooms();
  below.room[0] = -2;
  write_rooms(folder_ / "rooms.h5", below, cells_, provenance_);
  EXPECT_EQ(code_of([&] { read_rooms(folder_ / "rooms.h5", cells_); }), errors::kArtefactDamaged.id);
  below.storey.pop_back();
  EXPECT_THROW(write_rooms(folder_ / "rooms.h5", below, cells_, provenance_), std::logic_error);
}

}  // namespace
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/explain.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "stages/tools/evaluate/evaluate.h"
#include "tests/unit/mesh/shapes.h"

namespace roomcut::evaluate {
namespace {

using test::append;
using test::box;

using Values = std::vector<double>;

/// A complex of boxes: every inner value is a wall line or a level; the line at x = 3 is called "x3.000000".
CellComplex grid(const Values& xs, const Values& ys, const Values& zs) {
  CellComplex complex;
  complex.levels = zs;
  const auto nx = static_cast<std::int32_t>(xs.size()) - 1;
  const auto ny = static_cast<std::int32_t>(ys.size()) - 1;
  for (const double y : ys) {
    for (const double x : xs) complex.vertices.emplace_back(x, y);
  }
  const auto face = [&](std::int32_t x, std::int32_t y) {
    return x < 0 || y < 0 || x >= nx || y >= ny ? -1 : y * nx + x;
  };
  const auto vertex = [&](std::int32_t x, std::int32_t y) { return y * (nx + 1) + x; };
  const auto line = [&](const char* axis, double at, double theta, bool inner) {
    if (!inner) return -1;
    const std::string id = axis + std::to_string(at);
    for (std::size_t i = 0; i < complex.lines.size(); ++i) {
      if (complex.lines[i].wall_id == id) return static_cast<std::int32_t>(i);
    }
    complex.lines.push_back({id, {theta, at}, -10, 10, {}});
    return static_cast<std::int32_t>(complex.lines.size()) - 1;
  };
  const auto at = [](std::int32_t index) { return static_cast<std::size_t>(index); };
  std::vector<std::int32_t> upright(at((nx + 1) * ny));
  std::vector<std::int32_t> level(at(nx * (ny + 1)));
  for (std::int32_t y = 0; y < ny; ++y) {
    for (std::int32_t x = 0; x <= nx; ++x) {
      upright[at(y * (nx + 1) + x)] = static_cast<std::int32_t>(complex.edges.size());
      complex.edges.push_back({vertex(x, y), vertex(x, y + 1), face(x - 1, y), face(x, y),
                               line("x", xs[static_cast<std::size_t>(x)], 0, x > 0 && x < nx)});
    }
  }
  for (std::int32_t y = 0; y <= ny; ++y) {
    for (std::int32_t x = 0; x < nx; ++x) {
      level[at(y * nx + x)] = static_cast<std::int32_t>(complex.edges.size());
      complex.edges.push_back(
          {vertex(x, y), vertex(x + 1, y), face(x, y), face(x, y - 1),
           line("y", ys[static_cast<std::size_t>(y)], std::numbers::pi / 2, y > 0 && y < ny)});
    }
  }
  complex.face_offset = {0};
  for (std::int32_t y = 0; y < ny; ++y) {
    for (std::int32_t x = 0; x < nx; ++x) {
      for (const std::int32_t v : {vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)}) {
        complex.face_vertex.push_back(v);
      }
      for (const std::int32_t e : {level[at(y * nx + x)], upright[at(y * (nx + 1) + x + 1)],
                                   level[at((y + 1) * nx + x)], upright[at(y * (nx + 1) + x)]}) {
        complex.face_edge.push_back(e);
      }
      complex.face_offset.push_back(static_cast<std::int64_t>(complex.face_vertex.size()));
    }
  }
  return complex;
}

/// Cells whose middle lies in one of the boxes are empty.
LabelledCells labelled(const CellComplex& complex, const std::vector<std::array<Vec3, 2>>& empty) {
  LabelledCells cells{complex, std::vector<std::uint8_t>(complex.cells(), 0), {}, std::nullopt, {}};
  for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
    const Vec3 p = complex.centre(cell);
    for (const auto& [lo, hi] : empty) {
      if ((p.array() > lo.array()).all() && (p.array() < hi.array()).all()) cells.label[cell] = 1;
    }
  }
  return cells;
}

Explanation explained(const TriangleMesh& model, const TriangleMesh& truth, const LabelledCells& cells,
                      const std::vector<DescribedRoom>& rooms = {}) {
  EXPECT_EQ(find_violation(cells.complex), "");
  EvaluateParams params;
  params.sample_spacing_m = 0.05;
  params.column_spacing_m = 0.02;
  return *evaluate(model, truth, {rooms, {}}, params, &cells).explanation;
}

double total(const std::array<double, kCauses>& m3) {
  return std::accumulate(m3.begin(), m3.end(), 0.0);
}
double of(const std::array<double, kCauses>& m3, Cause cause) {
  return m3[static_cast<std::size_t>(cause)];
}

const TriangleMesh kRoom = box({1, 1, 0}, {4, 3, 2.5});  // 15 m3
const std::array<Vec3, 2> kRoomBox = {Vec3(1, 1, 0), Vec3(4, 3, 2.5)};
const Values kX = {0, 1, 4, 5}, kY = {0, 1, 3, 4}, kZ = {-0.5, 0, 2.5, 3};

TEST(Explain, NothingIsWrongWhenCellsAndLabelsAreTheTruths) {
  const Explanation e = explained(kRoom, kRoom, labelled(grid(kX, kY, kZ), {kRoomBox}));
  EXPECT_NEAR(e.bound_iou, 1, 1e-9);
  EXPECT_NEAR(e.labels_iou, 1, 1e-9);
  EXPECT_NEAR(e.empty_m3, 15, 1e-9);
  EXPECT_NEAR(total(e.lost_m3) + total(e.extra_m3), 0, 1e-9);
  ASSERT_EQ(e.rooms.size(), 1U);
  EXPECT_EQ(e.rooms[0].own.cells, 1U);
  EXPECT_NEAR(e.rooms[0].own.volume_m3, 15, 1e-9);
  EXPECT_NEAR(e.rooms[0].own_m3, e.rooms[0].volume_m3, 1e-9);
  EXPECT_TRUE(e.lost_walls.empty());
}

TEST(Explain, CellsEndAtTheSurfacesThatStandInPlaceOfTheirLevels) {
  // The level of the ceiling lies 12 cm too high, its surface where the ceiling is.
  const CellComplex complex = grid(kX, kY, {-0.5, 0, 2.62, 3});
  LabelledCells cells = labelled(complex, {kRoomBox});
  EXPECT_NEAR(explained(kRoom, kRoom, cells).bound_iou, 2.5 / 2.62, 0.002);
  cells.surfaces.of_face.assign(complex.faces() * complex.levels.size(), -1);
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    if (is_empty(cells.label, complex.cell(face, 1))) cells.surfaces.of_face[complex.level_face(face, 2)] = 0;
  }
  cells.surfaces.surfaces = {{{0.1, 0}, 2.25, 0, 6, 1, -1}};  // 2.5 m at the middle, x = 2.5
  EXPECT_LT(explained(kRoom, kRoom, cells).bound_iou, 0.98) << "a plane that the truth's ceiling is not";
  cells.surfaces.surfaces = {{{0, 0}, 2.5, 0, 6, 1, -1}};
  EXPECT_NEAR(explained(kRoom, kRoom, cells).bound_iou, 1, 1e-9);
}

TEST(Explain, ARoomLabelledSolidIsLostToLabelsAndItsEvidenceIsSummed) {
  const CellComplex complex = grid(kX, kY, kZ);
  LabelledCells cells = labelled(complex, {{Vec3(0, 0, -1), Vec3(1, 1, 0)}});  // a cell that is none: extra
  cells.terms.emplace();
  cells.terms->d_solid.assign(complex.cells(), 1);
  cells.terms->d_empty.assign(complex.cells(), 4);
  cells.terms->beta.assign(complex.cells(), 0.25F);
  cells.terms->observed.assign(complex.cells(), 0.5F);
  const Explanation e = explained(box({0, 0, -0.5}, {1, 1, 0}), kRoom, cells);
  EXPECT_NEAR(e.bound_iou, 1, 1e-9);
  EXPECT_NEAR(e.labels_iou, 0, 1e-9);
  EXPECT_NEAR(of(e.lost_m3, Cause::kLabels), 15, 0.15);
  EXPECT_NEAR(of(e.extra_m3, Cause::kLabels), 0.5, 0.02);
  EXPECT_NEAR(total(e.lost_m3) + total(e.extra_m3), 15.5, 0.15);
  EXPECT_EQ(e.rooms[0].own.empty_m3, 0);
  EXPECT_DOUBLE_EQ(e.rooms[0].own.evidence_m3, -3);
  EXPECT_DOUBLE_EQ(e.rooms[0].own.beta, 0.25);
  EXPECT_DOUBLE_EQ(e.rooms[0].own.observed, 0.5);
}

TEST(Explain, EveryCellSaysHowMuchOfItIsEmptyInTheTruthWhateverTheLabelsSay) {
  // Lines at x = 2 and 6, a level at 2: the room from x = 1 to 4, 2.5 m high, halves and sticks out of cells.
  const CellComplex complex = grid({0, 2, 4, 6, 8}, kY, {0, 2, 3});
  for (const bool all_empty : {false, true}) {
    const auto cells =
        labelled(complex, {all_empty ? std::array<Vec3, 2>{Vec3(-9, -9, -9), Vec3(9, 9, 9)} : kRoomBox});
    const Explanation e = explained(kRoom, kRoom, cells);
    ASSERT_EQ(e.cell_m3.size(), complex.cells());
    ASSERT_EQ(e.cell_truth_m3.size(), complex.cells());
    for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
      EXPECT_NEAR(e.cell_m3[cell] / complex.volume(cell), 1, 0.03);
      const Vec3 middle = complex.centre(cell);
      const double along = middle.y() < 1 || middle.y() > 3 || middle.x() > 4 ? 0 : middle.x() < 2 ? 0.5 : 1;
      EXPECT_NEAR(e.cell_truth_m3[cell] / e.cell_m3[cell], along * (complex.layer_of(cell) == 0 ? 1 : 0.5),
                  0.02)
          << middle.transpose();
    }
    EXPECT_NEAR(std::accumulate(e.cell_truth_m3.begin(), e.cell_truth_m3.end(), 0.0), 15, 0.15);
  }
}

TEST(Explain, ACellThatNoColumnMeetsCountsNowhere) {
  const CellComplex complex = grid({0, 1, 4, 4.000001, 5}, kY, kZ);
  const Explanation e = explained(kRoom, kRoom, labelled(complex, {kRoomBox}));
  double met = 0;
  for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
    const Vec3 middle = complex.centre(cell);
    if (middle.x() > 4 && middle.x() < 4.000001) {
      met += e.cell_m3[cell];
      EXPECT_EQ(e.cell_truth_m3[cell], 0);
    }
  }
  EXPECT_EQ(met, 0);
}

TEST(Explain, ALineFiveCentimetresOffIsMisplaced) {
  const auto cells = labelled(grid({0, 1.05, 4, 5}, kY, kZ), {{Vec3(1, 1, 0), Vec3(4, 3, 2.5)}});
  const Explanation e = explained(box({1.05, 1, 0}, {4, 3, 2.5}), kRoom, cells);
  EXPECT_NEAR(of(e.lost_m3, Cause::kLinesMisplaced), 0.05 * 2 * 2.5, 0.02);
  EXPECT_NEAR(total(e.lost_m3), 0.25, 0.02);
  EXPECT_NEAR(total(e.extra_m3), 0, 1e-9);
  EXPECT_NEAR(e.bound_iou, 14.75 / 15, 2e-3);
}

TEST(Explain, AWallWithoutALineIsMissing) {
  const auto cells = labelled(grid({0, 4, 5}, kY, kZ), {{Vec3(0, 1, 0), Vec3(4, 3, 2.5)}});
  const Explanation e = explained(box({0, 1, 0}, {4, 3, 2.5}), kRoom, cells);
  EXPECT_NEAR(of(e.extra_m3, Cause::kLinesMissing), 1 * 2 * 2.5, 0.1);
  EXPECT_NEAR(total(e.extra_m3), 5, 0.1);
  EXPECT_NEAR(total(e.lost_m3), 0, 1e-9);
  EXPECT_NEAR(e.bound_iou, 15.0 / 20, 5e-3);
  EXPECT_NEAR(e.labels_iou, e.bound_iou, 1e-12);
}

TEST(Explain, ACeilingWithoutALevelIsMissingAndOneNearByIsMisplaced) {
  const auto without = labelled(grid(kX, kY, {0, 3}), {{Vec3(1, 1, 0), Vec3(4, 3, 3)}});
  const Explanation missing = explained(box({1, 1, 0}, {4, 3, 3}), kRoom, without);
  EXPECT_NEAR(of(missing.extra_m3, Cause::kLevelsMissing), 3 * 2 * 0.5, 0.03);
  EXPECT_NEAR(total(missing.extra_m3), 3, 0.03);
  const auto beside = labelled(grid(kX, kY, {0, 2.45, 3}), {{Vec3(1, 1, 0), Vec3(4, 3, 2.45)}});
  const Explanation misplaced = explained(box({1, 1, 0}, {4, 3, 2.45}), kRoom, beside);
  EXPECT_NEAR(of(misplaced.lost_m3, Cause::kLevelsMisplaced), 3 * 2 * 0.05, 0.01);
  EXPECT_NEAR(total(misplaced.lost_m3) + total(misplaced.extra_m3), 0.3, 0.01);
}

TEST(Explain, WhatLiesBeyondTheLevelsIsOutside) {
  const auto cells = labelled(grid(kX, kY, {0, 2}), {{Vec3(1, 1, 0), Vec3(4, 3, 2)}});
  const Explanation e = explained(box({1, 1, 0}, {4, 3, 2}), kRoom, cells);
  EXPECT_NEAR(of(e.lost_m3, Cause::kOutside), 3, 0.03);
  EXPECT_NEAR(total(e.lost_m3), 3, 0.03);
  EXPECT_NEAR(e.bound_iou, 0.8, 2e-3);
}

TEST(Explain, ASlopedCeilingIsNamed) {
  TriangleMesh wedge = kRoom;
  for (Vec3& p : wedge.vertices) {
    if (p.x() == 4 && p.z() == 2.5) p.z() = 0.5;
  }
  const Explanation e = explained(kRoom, wedge, labelled(grid(kX, kY, kZ), {kRoomBox}));
  EXPECT_NEAR(of(e.extra_m3, Cause::kSloped), 6, 0.06);
  EXPECT_NEAR(total(e.extra_m3), 6, 0.06);
}

TEST(Explain, WhatIsInNoRoomIsAnOpening) {
  const DescribedRoom room{"room", {{1, 1}, {3.8, 1}, {3.8, 3}, {1, 3}}, 0, 2.5, {2, 2, 1}};
  const auto cells = labelled(grid({0, 1, 3.8, 5}, kY, kZ), {{Vec3(1, 1, 0), Vec3(3.8, 3, 2.5)}});
  const Explanation e = explained(box({1, 1, 0}, {3.8, 3, 2.5}), kRoom, cells, {room});
  EXPECT_NEAR(of(e.lost_m3, Cause::kOpenings), 0.2 * 2 * 2.5, 0.03);
  EXPECT_NEAR(total(e.lost_m3), 1, 0.03);
}

TEST(Explain, AnOpeningThatWasCutIsNotLostAndOneCutTooWideIsExtra) {
  const DescribedRoom room{"room", {{1, 1}, {3.8, 1}, {3.8, 3}, {1, 3}}, 0, 2.5, {2, 2, 1}};
  const auto cells = labelled(grid({0, 1, 3.8, 5}, kY, kZ), {{Vec3(1, 1, 0), Vec3(3.8, 3, 2.5)}});
  const TriangleMesh truth = box({1, 1, 0}, {4, 3, 2.5});
  EXPECT_NEAR(total(explained(truth, truth, cells, {room}).lost_m3), 0, 1e-6);
  const Explanation e = explained(box({1, 1, 0}, {4.2, 3, 2.5}), truth, cells, {room});
  EXPECT_NEAR(total(e.lost_m3), 0, 1e-6);
  EXPECT_NEAR(of(e.extra_m3, Cause::kOpenings), 0.2 * 2 * 2.5, 0.03);
  EXPECT_NEAR(total(e.extra_m3), 1, 0.03);
}

TEST(Explain, ALostWallSaysWhetherItHadCells) {
  TriangleMesh truth = box({1, 1, 0}, {3, 3, 2.5});
  append(truth, box({3.1, 1, 0}, {4, 3, 2.5}));
  const auto with = labelled(grid({0, 1, 3, 3.1, 4, 5}, kY, kZ), {kRoomBox});
  const Explanation e = explained(kRoom, truth, with);
  ASSERT_EQ(e.lost_walls.size(), 1U);
  EXPECT_EQ(e.lost_walls[0].a, 0);
  EXPECT_EQ(e.lost_walls[0].b, 1);
  EXPECT_NEAR(e.lost_walls[0].area_m2, 2 * 2 * 2.5, 0.1);  // both faces count
  EXPECT_EQ(e.lost_walls[0].no_cell_m2, 0);
  EXPECT_FALSE(e.lost_walls[0].slab);
  EXPECT_EQ(e.lost_walls[0].cells.cells, 1U);
  EXPECT_NEAR(e.lost_walls[0].cells.empty_m3, 0.1 * 2 * 2.5, 1e-9);
  EXPECT_EQ(e.lost_walls[0].wall_ids, (std::vector<std::string>{"x3.000000", "x3.100000"}));
  EXPECT_NEAR(of(e.extra_m3, Cause::kLabels), 0.5, 0.03);
  const Explanation none = explained(kRoom, truth, labelled(grid(kX, kY, kZ), {kRoomBox}));
  ASSERT_EQ(none.lost_walls.size(), 1U);
  EXPECT_NEAR(none.lost_walls[0].no_cell_m2, none.lost_walls[0].area_m2, 1e-9);
  EXPECT_TRUE(none.lost_walls[0].wall_ids.empty());
  EXPECT_NEAR(of(none.extra_m3, Cause::kLinesMissing) + of(none.extra_m3, Cause::kLinesMisplaced), 0.5, 0.03);
}

TEST(Explain, AnOpeningAsWideAsTheWallJoinsNoRoomsAMissingWallDoes) {
  TriangleMesh truth = box({1, 1, 0}, {3, 3, 2.5});
  append(truth, box({3.1, 1, 0}, {4, 3, 2.5}));
  const CellComplex complex = grid({0, 1, 3, 3.1, 4, 5}, kY, kZ);
  const auto closed =
      labelled(complex, {{Vec3(1, 1, 0), Vec3(3, 3, 2.5)}, {Vec3(3.1, 1, 0), Vec3(4, 3, 2.5)}});
  const auto missing = labelled(complex, {kRoomBox});
  const EvaluateParams params{0.05, 0.05};
  EXPECT_TRUE(evaluate(kRoom, truth, {}, params, &closed).merged.empty());
  EXPECT_LT(evaluate(kRoom, truth, {}, params, &closed).thin.wall_kept_m2, 1e-9);
  EXPECT_EQ(evaluate(kRoom, truth, {}, params, &missing).merged.size(), 1U);
}

TEST(Explain, FollowsTheFrame) {
  const Vec3 by(100, -50, 7);
  LabelledCells cells = labelled(grid(kX, kY, kZ), {kRoomBox});
  cells.complex = moved(cells.complex, by);
  const TriangleMesh truth = box(Vec3(1, 1, 0) + by, Vec3(4, 3, 2.5) + by);
  EXPECT_NEAR(explained(truth, truth, cells).labels_iou, 1, 1e-9);
}

// Two rooms of 15 m3 with a wall of 0.2 m between them; nobody entered the second. Cells in and around them.
const TriangleMesh kSecond = box({4.2, 1, 0}, {7.2, 3, 2.5});
const Values kX2 = {0, 1, 4, 4.2, 7.2, 9};
TriangleMesh pair_of_rooms() {
  TriangleMesh mesh = kRoom;
  append(mesh, kSecond);
  return mesh;
}
TruthDescription second_not_entered() {
  return {{{"entered", {}, 0, 2.5, {2, 2, 1}, true}, {"closed", {}, 0, 2.5, {5, 2, 1}, false}}, {}};
}
Scores scored(const TriangleMesh& model, const TriangleMesh& truth, const TruthDescription& described,
              const LabelledCells& cells) {
  EvaluateParams params;
  params.sample_spacing_m = 0.05;
  params.column_spacing_m = 0.02;
  return evaluate(model, truth, described, params, &cells);
}

TEST(Unknown, ARoomThatNobodyEnteredIsDeniedWhenSolidAndUnknownWhenLabelledSo) {
  LabelledCells cells = labelled(grid(kX2, kY, kZ), {kRoomBox});
  const Scores denied = scored(kRoom, pair_of_rooms(), second_not_entered(), cells);
  EXPECT_NEAR(denied.volume->iou(), 0.5, 0.01);
  EXPECT_NEAR(denied.volume->seen.iou(), 1, 1e-9);
  EXPECT_EQ(denied.unentered().rooms, (std::array<std::size_t, 3>{0, 0, 1}));
  EXPECT_NEAR(denied.unentered().denied_m3(), 15, 0.1);
  EXPECT_NEAR(of(denied.explanation->lost_m3, Cause::kLabels), 15, 0.1);

  const auto cell = static_cast<std::size_t>(FaceLocator(cells.complex).cell_at({5, 2, 1}));
  cells.label[cell] = Label::kUnknown;
  const Scores unknown = scored(kRoom, pair_of_rooms(), second_not_entered(), cells);
  EXPECT_NEAR(unknown.volume->iou(), 0.5, 0.01) << "it is no part of the model";
  EXPECT_EQ(unknown.unentered().rooms, (std::array<std::size_t, 3>{0, 1, 0}));
  EXPECT_LT(unknown.unentered().denied_m3(), 0.1);
  EXPECT_NEAR(unknown.volume->unknown_in_truth_m3, 15, 0.1);
  EXPECT_NEAR(of(unknown.explanation->lost_m3, Cause::kUnknown), 15, 0.1);
  EXPECT_NEAR(of(unknown.explanation->lost_m3, Cause::kLabels), 0, 1e-9);
}

TEST(Unknown, ARoomThatWasEnteredIsLostOverWhatWasSeenEvenWhenUnknown) {
  LabelledCells cells = labelled(grid(kX2, kY, kZ), {kRoomBox});
  cells.label[static_cast<std::size_t>(FaceLocator(cells.complex).cell_at({5, 2, 1}))] = Label::kUnknown;
  TruthDescription described = second_not_entered();
  described.rooms[1].scanned = true;
  const Scores scores = scored(kRoom, pair_of_rooms(), described, cells);
  EXPECT_NEAR(scores.volume->seen.iou(), 0.5, 0.01);
  EXPECT_EQ(scores.unentered().volume_m3, 0);
}

TEST(Invented, AGardenThatBecameARoomIsListedAndALostWallIsNot) {
  const LabelledCells garden = labelled(grid(kX2, kY, kZ), {kRoomBox, {Vec3(4.2, 1, 0), Vec3(7.2, 3, 2.5)}});
  const auto invented = scored(pair_of_rooms(), kRoom, {}, garden).explanation->invented;
  ASSERT_EQ(invented.size(), 1U);
  EXPECT_NEAR(invented[0].volume_m3, 15, 0.1);
  EXPECT_NEAR((invented[0].centre - Vec3(5.7, 2, 1.25)).norm(), 0, 0.01);

  const TriangleMesh joined = box({1, 1, 0}, {7.2, 3, 2.5});
  const LabelledCells no_wall = labelled(grid(kX2, kY, kZ), {{Vec3(1, 1, 0), Vec3(7.2, 3, 2.5)}});
  const Scores scores = scored(joined, pair_of_rooms(), {}, no_wall);
  EXPECT_NEAR(of(scores.explanation->extra_m3, Cause::kLabels), 1, 0.02);
  EXPECT_TRUE(scores.explanation->invented.empty());
}

TEST(Ignored, ARoomInAnIgnoredBoxCountsNowhereAndOneOfTheTruthEverywhere) {
  const LabelledCells both = labelled(grid(kX2, kY, kZ), {kRoomBox, {Vec3(4.2, 1, 0), Vec3(7.2, 3, 2.5)}});
  const Bounds3 around{{4.1, 0.9, -0.1}, {7.3, 3.1, 2.6}};
  TruthDescription described;
  described.ignored = IgnoredSpace({around}, {});
  const Scores more = scored(pair_of_rooms(), kRoom, described, both);
  EXPECT_NEAR(more.volume->iou(), 1, 1e-9);
  EXPECT_NEAR(more.explanation->labels_iou, 1, 1e-9);
  EXPECT_NEAR(more.volume->ignored_m3, 15, 0.1);
  EXPECT_LT(more.model_to_truth.max, 1e-9);
  EXPECT_NEAR(total(more.explanation->extra_m3), 0, 1e-9);
  EXPECT_TRUE(more.explanation->invented.empty());
  const Scores less = scored(kRoom, pair_of_rooms(), described, labelled(grid(kX2, kY, kZ), {kRoomBox}));
  EXPECT_NEAR(less.volume->iou(), 0.5, 0.01) << "the truth has this room";
  EXPECT_EQ(less.found(), 1U);
}

TEST(Ignored, TheBoxesKeepTheAxesOfTheFilesWhenTheCellsAreLevel) {
  const double lean = 0.02;
  const ComparedAxes axes{{10, 0, 0}, Eigen::AngleAxisd(lean, Vec3::UnitX()).toRotationMatrix()};
  const IgnoredSpace ignored({{{10, -1, 0}, {12, 100, 1}}}, axes);
  EXPECT_TRUE(ignored.contains(axes.from_file({11, 99, 0.5})));
  EXPECT_FALSE(ignored.contains(axes.from_file({11, 99, 1.5})));
  std::vector<Interval> parts;
  const Vec3 low = axes.from_file({11, 99, 0});
  ignored.at(low.x(), low.y(), {}, parts);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(parts[0].length(), 1 / std::cos(lean), 1e-9);
  EXPECT_NEAR(parts[0].lo, low.z(), 1e-9);
}

}  // namespace
}  // namespace roomcut::evaluate

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/one_sided.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::refine_lines {
using namespace roomcut::raycast;
using namespace roomcut::weigh_faces;

namespace {

/// Two rooms side by side, both empty, with one wall line between them at x = 4 that was seen from the west,
/// turned by `turn`.
struct HalfSeenWall {
  explicit HalfSeenWall(double turn)
      : complex(grid_complex({-1, 0, 4, 8, 9}, {-1, 0, 4, 5}, {0, 2.6, 3}, turn)) {
    const Vec2 middle(4 * std::cos(turn) - 2 * std::sin(turn), 4 * std::sin(turn) + 2 * std::cos(turn));
    edge = edge_near(complex, middle);
    weights = no_weights(complex);
    const std::size_t w = complex.wall_face(edge, 0);
    weights.wall_omega[w] = 0.9F;
    weights.wall_left[w] = 0.9F;
    label.assign(complex.cells(), Label::kSolid);
    label[complex.cell(5, 0)] = label[complex.cell(6, 0)] = Label::kEmpty;
    for (const CellComplex::Line& line : complex.lines) {
      WallLine wall;
      wall.id = line.wall_id;
      wall.a = line.line.at(line.t0);
      wall.b = line.line.at(line.t1);
      lines.lines.push_back(wall);
    }
  }
  CellComplex complex;
  std::size_t edge = 0;
  FaceWeights weights;
  std::vector<std::uint8_t> label;
  WallLines lines;
};

TEST(OneSided, AWallSeenFromOneSideGetsItsUnseenFaceBehindIt) {
  for (const double turn : {0.0, 0.4, 2.0, 4.0}) {
    HalfSeenWall scene(turn);
    const auto walls = find_one_sided(scene.complex, scene.weights, scene.label, 3);
    ASSERT_EQ(walls.size(), 1U);
    EXPECT_NEAR(walls[0].area_m2, 0.9 * 4 * 2.6, 1e-6);
    EXPECT_EQ(walls[0].layers, std::vector<std::int32_t>{0});
    ASSERT_EQ(add_unseen_faces(walls, 0.2, scene.lines), 1);
    const WallLine* unseen = nullptr;
    for (const WallLine& line : scene.lines.lines) unseen = line.note.empty() ? unseen : &line;
    ASSERT_NE(unseen, nullptr);
    const Vec2 east(std::cos(turn), std::sin(turn));
    EXPECT_NEAR(unseen->a.dot(east), 4.2, 1e-9);
    EXPECT_NEAR(unseen->b.dot(east), 4.2, 1e-9);
    EXPECT_NEAR(unseen->length(), 4, 1e-9);
  }
}

TEST(OneSided, TheUnseenFaceIsBehindWhereTheRefinedLineLooksTheOtherWay) {
  for (const double tilt_m : {0.002, -0.002}) {  // theta just above 0, just below pi
    HalfSeenWall scene(0);
    const auto walls = find_one_sided(scene.complex, scene.weights, scene.label, 3);
    ASSERT_EQ(walls.size(), 1U);
    for (WallLine& line : scene.lines.lines) {
      if (line.id == walls[0].wall_id) line.b.x() += tilt_m;
    }
    ASSERT_EQ(add_unseen_faces(walls, 0.2, scene.lines), 1);
    for (const WallLine& line : scene.lines.lines) {
      if (line.note.empty()) continue;
      EXPECT_NEAR(line.a.x(), 4.2, 0.003);
      EXPECT_NEAR(line.b.x(), 4.2, 0.003);
      EXPECT_NEAR(std::min(line.a.y(), line.b.y()), 0, 0.01);
      EXPECT_NEAR(std::max(line.a.y(), line.b.y()), 4, 0.01);
    }
  }
}

TEST(OneSided, NoneWhereALineRunsBehindOrNothingIsClear) {
  HalfSeenWall scene(0);
  const auto walls = find_one_sided(scene.complex, scene.weights, scene.label, 3);
  WallLine behind;
  behind.id = "w9";
  behind.a = {4.1, 0};
  behind.b = {4.1, 4};
  scene.lines.lines.push_back(behind);
  EXPECT_EQ(add_unseen_faces(walls, 0.2, scene.lines), 0);

  EXPECT_TRUE(find_one_sided(scene.complex, scene.weights, scene.label, 20).empty()) << "too small";
  scene.weights.wall_right[scene.complex.wall_face(scene.edge, 0)] = 0.4F;
  scene.weights.wall_left[scene.complex.wall_face(scene.edge, 0)] = 0.5F;
  EXPECT_TRUE(find_one_sided(scene.complex, scene.weights, scene.label, 3).empty()) << "no side is clear";
}

TEST(OneSided, ALineThatMayNotCarryInTheWallsLayersDoesNotCloseIt) {
  HalfSeenWall scene(0);
  const auto walls = find_one_sided(scene.complex, scene.weights, scene.label, 3);
  WallLine behind;
  behind.id = "w9";
  behind.a = {4.1, 0};
  behind.b = {4.1, 4};
  behind.levels = {1};
  scene.lines.lines.push_back(behind);
  EXPECT_EQ(add_unseen_faces(walls, 0.2, scene.lines), 1);
}

TEST(OneSided, AWallBetweenEmptyAndSolidIsNone) {
  HalfSeenWall scene(0);
  scene.label[scene.complex.cell(6, 0)] = Label::kSolid;
  EXPECT_TRUE(find_one_sided(scene.complex, scene.weights, scene.label, 3).empty());
}

TEST(UsualThickness, IsTheDistanceBetweenTheFacesOfWalls) {
  const CellComplex complex = grid_complex({-1, 0, 4, 4.12, 8, 8.3, 9, 10}, {-1, 0, 4, 5}, {0, 2.6});
  std::vector<std::uint8_t> label(complex.cells(), Label::kSolid);
  EXPECT_NEAR(usual_thickness(complex, label), 0.15, 1e-9) << "no wall tells";
  for (const std::size_t face : {8U, 10U}) label[face] = Label::kEmpty;
  EXPECT_NEAR(usual_thickness(complex, label), 0.12, 1e-9);
}

}  // namespace
}  // namespace roomcut::refine_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/carried_layers.h"

#include <gtest/gtest.h>

#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::refine_lines {
using namespace roomcut::raycast;
using namespace roomcut::weigh_faces;

namespace {

/// Two storeys and the slab between. The wall at x = 4 stands in the lower storey, that at x = 4.06 in the
/// upper one; both lines cut all layers.
struct TwoStoreys {
  TwoStoreys() {
    std::vector<bool> empty(complex.cells(), false);
    empty[complex.cell(5, 0)] = true;
    empty[complex.cell(5, 2)] = empty[complex.cell(6, 2)] = true;
    weights = weights_of(complex, empty);
    label.assign(empty.begin(), empty.end());
    for (const CellComplex::Line& line : complex.lines) {
      WallLine wall;
      wall.id = line.wall_id;
      wall.a = line.line.at(line.t0);
      wall.b = line.line.at(line.t1);
      lines.lines.push_back(wall);
    }
  }
  void restrict_lines() {
    CarriedRuns carried = find_carried_runs(complex, weights, label);
    restrict_to_carried_layers(complex, {}, carried, lines);
  }
  const std::optional<std::vector<int>>& levels_at(double x) const {
    const std::size_t edge = edge_near(complex, {x, 2});
    return lines.lines[static_cast<std::size_t>(complex.edges[edge].line)].levels;
  }
  CellComplex complex = grid_complex({-1, 0, 4, 4.06, 9}, {-1, 0, 4, 5}, {0, 2.6, 2.9, 5.5});
  FaceWeights weights;
  std::vector<std::uint8_t> label;
  WallLines lines;
};

TEST(CarriedLayers, ALineCarriesWhereTheFirstCutHasSurfaceOnIt) {
  TwoStoreys scene;
  scene.restrict_lines();
  EXPECT_EQ(scene.levels_at(4), std::vector<int>{0});
  EXPECT_EQ(scene.levels_at(4.06), std::vector<int>{2});
}

TEST(CarriedLayers, AWallSurelySeenCarriesWithoutTheCut) {
  TwoStoreys scene;
  scene.weights.wall_omega[scene.complex.wall_face(edge_near(scene.complex, {4, 2}), 2)] = 0.45F;
  scene.restrict_lines();
  EXPECT_EQ(scene.levels_at(4), (std::vector<int>{0, 2}));
}

TEST(CarriedLayers, AWallThatIsOnlyLikelyDoesNotOverruleTheCut) {
  TwoStoreys scene;
  scene.weights.wall_omega[scene.complex.wall_face(edge_near(scene.complex, {4, 2}), 2)] = 0.35F;
  scene.restrict_lines();
  EXPECT_EQ(scene.levels_at(4), std::vector<int>{0});
}

TEST(CarriedLayers, LinesOfTheUsersAndThoseOfNothingStayAsTheyAre) {
  TwoStoreys scene;
  for (WallLine& line : scene.lines.lines) line.source = LineSource::kEdited;
  scene.restrict_lines();
  EXPECT_FALSE(scene.levels_at(4).has_value());
  for (WallLine& line : scene.lines.lines) line.source = LineSource::kDetected;
  scene.weights = no_weights(scene.complex);
  scene.label.assign(scene.complex.cells(), 0);
  scene.restrict_lines();
  EXPECT_FALSE(scene.levels_at(4).has_value());
}

/// A wall at x = 4 in the upper storey; in the lower one it stands at x = 4.03, but the first cut left a
/// corner of 15 cm on the upper one's line. Above the lower storey lies a layer of 30 cm of the same room.
struct Sliver {
  explicit Sliver(bool corner_between) {
    std::vector<bool> empty(complex.cells(), false);
    const std::size_t corner = 5, room = 9, sliver = 10;  // plan faces
    empty[complex.cell(room, 0)] = empty[complex.cell(corner, 0)] = empty[complex.cell(sliver, 0)] = true;
    empty[complex.cell(room, 1)] = empty[complex.cell(corner, 1)] = empty[complex.cell(sliver, 1)] = true;
    empty[complex.cell(room, 3)] = empty[complex.cell(corner, 3)] = true;
    empty[complex.cell(corner, 2)] = corner_between;
    weights = weights_of(complex, empty);
    label.assign(empty.begin(), empty.end());
    carried = find_carried_runs(complex, weights, label);
  }
  const CarriedLine& at(double x) const {
    return carried[static_cast<std::size_t>(complex.edges[edge_near(complex, {x, 2})].line)];
  }
  bool holds(double x, std::size_t layer, double y) const {
    const Line2& line =
        complex.lines[static_cast<std::size_t>(complex.edges[edge_near(complex, {x, 2})].line)].line;
    return at(x).holds(layer, line.along({x, y}));
  }
  CellComplex complex = grid_complex({-1, 0, 4, 4.03, 9}, {-1, 0, 0.15, 4, 5}, {0, 2.3, 2.6, 2.9, 5.5});
  FaceWeights weights;
  std::vector<std::uint8_t> label;
  CarriedRuns carried;
};

TEST(CarriedRuns, AShortPieceBesideALongerWallIsThatWalls) {
  const Sliver scene(false);
  EXPECT_FALSE(scene.holds(4, 0, 0.07));
  EXPECT_TRUE(scene.holds(4.03, 0, 2));
  EXPECT_TRUE(scene.holds(4, 3, 2));
}

TEST(CarriedRuns, AShortPieceBelowALongOneIsThatWalls) {
  EXPECT_TRUE(Sliver(true).holds(4, 2, 0.07));
}

}  // namespace
}  // namespace roomcut::refine_lines

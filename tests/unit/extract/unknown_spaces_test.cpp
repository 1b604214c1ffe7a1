// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/unknown_spaces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "stages/extract/extract.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut::extract {
namespace {

/// From the left: a seen room of 4 x 4 m, a wall of 0.2 m, an unknown space of 3 x 4 m in two cells.
struct Scene {
  CellComplex complex = test::grid_complex({-1, 0, 4, 4.2, 5.2, 7.2, 8}, {-1, 0, 4, 5}, {-0.3, 0, 2.5, 3});
  Labels labels;
  FaceWeights weights;
  DataTerms terms;

  Scene() {
    const auto inside = [](const Vec2& p, double z, double x0, double x1) {
      return p.x() > x0 && p.x() < x1 && p.y() > 0 && p.y() < 4 && z > 0 && z < 2.5;
    };
    labels = test::label_where(complex, [&](const Vec2& p, double z) { return inside(p, z, 0, 4); });
    weights.wall_omega.assign(complex.edges.size() * complex.layers(), 0);
    weights.level_omega.assign(complex.faces() * complex.levels.size(), 0);
    terms.reset(complex);
    for (std::size_t c = 0; c < complex.cells(); ++c) {
      const Vec3 at = complex.centre(c);
      if (inside(at.head<2>(), at.z(), 4.2, 7.2)) {
        labels.label[c] = Label::kUnknown;
        terms.observed[c] = 0.8F;
        terms.around[c] = -0.4F;
        terms.closed[c] = 0.9F;
        terms.beta[c] = at.x() < 5.2 ? 0.3F : 0.6F;
      }
    }
  }

  Model model() const {
    Model model = extract_model(complex, labels, {}, {});
    list_unknown_spaces(complex, labels, weights, terms, {}, model);
    return model;
  }
};

TEST(UnknownSpaces, AnUnknownSpaceIsNoPartOfTheModel) {
  const Scene scene;
  const Model model = scene.model();
  EXPECT_EQ(model.fault, "");
  EXPECT_NEAR(model.empty_m3, 4 * 4 * 2.5, 1e-9);
  EXPECT_EQ(model.rooms.size(), 1U);
}

TEST(UnknownSpaces, ItIsListedWithItsPlaceItsSizeItsReasonAndTheRoomsBeside) {
  const Model model = Scene().model();
  ASSERT_EQ(model.unknown_spaces.size(), 1U);
  const UnknownSpace& space = model.unknown_spaces[0];
  EXPECT_NEAR(space.measures.area_m2, 12, 1e-9);
  EXPECT_NEAR(space.measures.volume_m3, 30, 1e-9);
  EXPECT_NEAR(space.measures.floor_z, 0, 1e-9);
  EXPECT_NEAR(space.measures.ceiling_z, 2.5, 1e-9);
  EXPECT_LT((space.place - Vec2(6.2, 2)).norm(), 1e-9) << "the middle of its larger cell";
  EXPECT_NEAR(space.seen_inside, 0.2, 1e-6);
  EXPECT_NEAR(space.closed, 0.9, 1e-6);
  EXPECT_NEAR(space.probability, 0.5, 1e-6);
  EXPECT_TRUE(space.is_closed());
  ASSERT_EQ(space.beside.size(), 1U) << "the room behind the wall of 0.2 m";
  EXPECT_EQ(space.beside[0].room, 0);
  EXPECT_NEAR(space.beside[0].area_m2, 4 * 2.5, 1e-9);
}

TEST(UnknownSpaces, EveryUnknownCellKnowsItsSpaceAndNoOther) {
  const Scene scene;
  const Model model = scene.model();
  for (std::size_t c = 0; c < scene.complex.cells(); ++c) {
    EXPECT_EQ(model.cell_rooms.unknown_space[c], is_unknown(scene.labels.label, c) ? 0 : -1);
    EXPECT_EQ(model.cell_rooms.room[c], is_empty(scene.labels.label, c) ? 0 : -1);
  }
}

TEST(UnknownSpaces, AWallThatWasSeenPartsTwoOfThemAndTheLargerComesFirst) {
  Scene scene;
  for (std::size_t e = 0; e < scene.complex.edges.size(); ++e) {
    const CellComplex::Edge& edge = scene.complex.edges[e];
    const double x0 = scene.complex.vertices[static_cast<std::size_t>(edge.v0)].x();
    const double x1 = scene.complex.vertices[static_cast<std::size_t>(edge.v1)].x();
    if (x0 > 5.1 && x0 < 5.3 && x1 > 5.1 && x1 < 5.3) {
      scene.weights.wall_omega[scene.complex.wall_face(e, 1)] = 1;
    }
  }
  const Model model = scene.model();
  ASSERT_EQ(model.unknown_spaces.size(), 2U);
  EXPECT_NEAR(model.unknown_spaces[0].measures.area_m2, 8, 1e-9);
  EXPECT_NEAR(model.unknown_spaces[1].measures.area_m2, 4, 1e-9);
  EXPECT_TRUE(model.unknown_spaces[0].beside.empty()) << "the room lies beyond the other one";
}

TEST(UnknownSpaces, WithoutUnknownCellsThereAreNone) {
  Scene scene;
  std::replace(scene.labels.label.begin(), scene.labels.label.end(), Label::kUnknown, Label::kSolid);
  EXPECT_TRUE(scene.model().unknown_spaces.empty());
}

}  // namespace
}  // namespace roomcut::extract

// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/cell_complex.h"

#include <gtest/gtest.h>

#include "tests/unit/cells/three_faces.h"

namespace roomcut {
namespace {

TEST(CellComplex, AreasAndCentroidsIgnoreVerticesInTheMiddleOfASide) {
  const CellComplex complex = three_faces();
  EXPECT_DOUBLE_EQ(complex.area(0), 2);
  EXPECT_DOUBLE_EQ(complex.area(1), 3);
  EXPECT_NEAR((complex.centroid(0) - Vec2(0.5, 1)).norm(), 0, 1e-15);
  EXPECT_NEAR((complex.centroid(2) - Vec2(2.5, 1.5)).norm(), 0, 1e-15);
}

TEST(CellComplex, AreasKeepTheirDigitsFarFromTheOrigin) {
  CellComplex complex = three_faces();
  for (Vec2& p : complex.vertices) {
    p += Vec2(3e5, -5e6);
  }
  EXPECT_DOUBLE_EQ(complex.area(0), 2);
  EXPECT_NEAR((complex.centroid(1) - Vec2(3e5 + 2.5, -5e6 + 0.5)).norm(), 0, 1e-9);
}

TEST(CellComplex, IndicesOfTheProductsDoNotCollide) {
  const CellComplex complex = three_faces();
  EXPECT_EQ(complex.cells(), 6U);
  EXPECT_EQ(complex.cell(2, 1), 5U);
  EXPECT_EQ(complex.wall_face(9, 1), 19U);
  EXPECT_EQ(complex.level_face(2, 2), 8U);
  EXPECT_DOUBLE_EQ(complex.height(1), 0.5);
  EXPECT_DOUBLE_EQ(complex.length(7), 3);
}

TEST(CellComplex, EveryIndexLeadsBackToItsElement) {
  const CellComplex complex = three_faces();
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    for (std::size_t level = 0; level < complex.levels.size(); ++level) {
      EXPECT_EQ(complex.face_of_level(complex.level_face(face, level)), face);
      EXPECT_EQ(complex.level_of(complex.level_face(face, level)), level);
    }
    for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
      EXPECT_EQ(complex.face_of(complex.cell(face, layer)), face);
      EXPECT_EQ(complex.layer_of(complex.cell(face, layer)), layer);
    }
  }
  for (std::size_t edge = 0; edge < complex.edges.size(); ++edge) {
    EXPECT_EQ(complex.edge_of_wall(complex.wall_face(edge, 1)), edge);
    EXPECT_EQ(complex.layer_of_wall(complex.wall_face(edge, 1)), 1U);
  }
}

TEST(CellComplex, CornersGoRoundTheFaceAndEdgesJoinThem) {
  const CellComplex complex = three_faces();
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    const FaceCorners corners = complex.corners(face);
    ASSERT_EQ(corners.size(), complex.edges_of(face).size());
    EXPECT_EQ(static_cast<std::size_t>(std::distance(corners.begin(), corners.end())), corners.size());
    std::size_t i = 0;
    for (const Vec2& corner : corners) {
      EXPECT_EQ(corner, corners[i]);
      const CellComplex::Edge& edge = complex.edges[complex.edges_of(face)[i]];
      const auto is_end = [&](const Vec2& p) {
        return p == complex.vertices[edge.v0] || p == complex.vertices[edge.v1];
      };
      EXPECT_TRUE(is_end(corner) && is_end(corners.after(i)));
      EXPECT_TRUE(edge.left == static_cast<std::int32_t>(face) ||
                  edge.right == static_cast<std::int32_t>(face));
      EXPECT_NE(edge.across(static_cast<std::int32_t>(face)), static_cast<std::int32_t>(face));
      ++i;
    }
  }
}

TEST(CellComplex, CellsHaveVolumeAndCentre) {
  const CellComplex complex = three_faces();
  EXPECT_DOUBLE_EQ(complex.volume(complex.cell(1, 0)), 7.5);
  EXPECT_DOUBLE_EQ(complex.volume(complex.cell(0, 1)), 1);
  EXPECT_NEAR((complex.centre(complex.cell(2, 1)) - Vec3(2.5, 1.5, 2.75)).norm(), 0, 1e-15);
}

TEST(CellComplex, ALayerBeginsAtItsLowerLevelAndBeyondAllIsNone) {
  const CellComplex complex = three_faces();
  EXPECT_EQ(complex.layer_at(0), 0);
  EXPECT_EQ(complex.layer_at(2.4999), 0);
  EXPECT_EQ(complex.layer_at(2.5), 1);
  EXPECT_EQ(complex.layer_at(-1e-9), -1);
  EXPECT_EQ(complex.layer_at(3), -1);
}

TEST(CellComplex, BeyondTheBoundingBoxAllIsSolid) {
  const CellComplex complex = three_faces();
  std::vector<std::uint8_t> label(complex.cells(), Label::kSolid);
  label[complex.cell(1, 1)] = Label::kEmpty;
  EXPECT_TRUE(is_empty(complex, label, 1, 1));
  EXPECT_FALSE(is_empty(complex, label, 1, 0));
  EXPECT_FALSE(is_empty(complex, label, -1, 1));
  EXPECT_TRUE(is_empty(label, complex.cell(1, 1)));
  EXPECT_FALSE(is_empty(label, std::int64_t{-1}));
}

}  // namespace
}  // namespace roomcut

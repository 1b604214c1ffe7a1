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

}  // namespace
}  // namespace roomcut

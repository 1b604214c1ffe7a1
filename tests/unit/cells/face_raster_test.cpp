// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/face_raster.h"

#include <gtest/gtest.h>

#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut {
namespace {

using weigh_faces::grid_complex;

std::vector<double> areas_of(const FaceRaster& raster, std::size_t faces) {
  std::vector<double> area(faces, 0.0);
  for (std::size_t i = 0; i < raster.pieces(); ++i) {
    area[static_cast<std::size_t>(raster.piece(i).face)] += raster.piece(i).area;
  }
  return area;
}

TEST(FaceRaster, PiecesAddUpToTheFacesWhateverTheirDirection) {
  for (const double turn : {0.0, 0.3, 1.1}) {
    const CellComplex complex = grid_complex({0, 1, 1.1, 5}, {0, 2, 3.3}, {0, 3}, turn);
    const std::vector<double> area = areas_of(FaceRaster(complex, 0.08, 0.0), complex.faces());
    for (std::size_t f = 0; f < complex.faces(); ++f) {
      EXPECT_NEAR(area[f], complex.area(f), 1e-4) << "face " << f << " turned by " << turn;
    }
  }
}

TEST(FaceRaster, LiesOnTheFacesInTheSameWayWhereverTheBoxEnds) {
  const auto pieces_of = [](double box) {
    const CellComplex complex = grid_complex({-box, 1, 1.1, 5}, {-box, 2, 3.3}, {0, 3});
    const FaceRaster raster(complex, 0.08, 0.0);
    std::vector<float> areas;
    for (std::size_t i = 0; i < raster.pieces(); ++i) {
      if (raster.piece(i).face == 4) {  // x 1 … 1.1, y 2 … 3.3
        areas.push_back(raster.piece(i).area);
      }
    }
    return areas;
  };
  const std::vector<float> areas = pieces_of(0.5);
  for (const double box : {0.5001, 0.53, 2.77}) {
    EXPECT_EQ(pieces_of(box), areas) << box;
  }
}

TEST(FaceRaster, FindsThePieceOfAPointAndNothingWithinTheMargin) {
  const CellComplex complex = grid_complex({0, 1, 1.1, 5}, {0, 2, 3.3}, {0, 3}, 0.3);
  const FaceRaster raster(complex, 0.08, 0.015);
  const auto at = [](double x, double y) {
    return Vec2(std::cos(0.3) * x - std::sin(0.3) * y, std::sin(0.3) * x + std::cos(0.3) * y);
  };
  const auto face_at = [&](double x, double y) {
    const std::int64_t piece = raster.find(at(x, y));
    return piece < 0 ? -1 : raster.piece(static_cast<std::size_t>(piece)).face;
  };
  EXPECT_EQ(face_at(0.5, 1.0), 0);
  EXPECT_EQ(face_at(1.05, 1.0), 1);
  EXPECT_EQ(face_at(1.02, 1.0), 1);
  EXPECT_EQ(face_at(3.0, 3.0), 5);
  EXPECT_EQ(face_at(1.01, 1.0), -1) << "1 cm inside the thin face: margin";
  EXPECT_EQ(face_at(0.99, 1.0), -1) << "1 cm before the line: margin";
  EXPECT_EQ(face_at(-0.5, 1.0), -1);
  EXPECT_EQ(face_at(9.0, 1.0), -1);
}

TEST(FaceRaster, ThinFacesKeepThreeFifthsOfTheirWidth) {
  const CellComplex complex = grid_complex({0, 1, 1.02, 5}, {0, 2}, {0, 3});
  const std::vector<double> area = areas_of(FaceRaster(complex, 0.08, 0.015), complex.faces());
  EXPECT_NEAR(area[1], 0.6 * 0.02 * (2 - 2 * 0.004), 1e-5);
}

}  // namespace
}  // namespace roomcut

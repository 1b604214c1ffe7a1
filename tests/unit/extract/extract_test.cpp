// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/extract.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/errors/error.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut::extract {
namespace {

using test::grid_complex;
using test::label_where;

bool within(const Vec2& p, double x0, double x1, double y0, double y1) {
  return p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1;
}

Model extract(const CellComplex& complex, const Labels& labels) {
  return extract_model(complex, labels, {}, {});
}

void expect_sound(const Model& model) {
  EXPECT_EQ(model.fault, "");
  EXPECT_TRUE(model.check.valid()) << describe_faults(model.check);
  EXPECT_NEAR(model.check.volume_m3, model.empty_m3, 1e-9 * model.empty_m3);
}

TEST(Extract, OneRoomIsTwelveTrianglesWithNormalsIntoTheWall) {
  const CellComplex complex = grid_complex({0, 1, 5, 6}, {0, 1, 4, 6}, {0, 0.5, 3, 4});
  const Model model = extract(complex, label_where(complex, [](const Vec2& p, double z) {
                                return within(p, 1, 5, 1, 4) && z > 0.5 && z < 3;
                              }));
  expect_sound(model);
  EXPECT_EQ(model.surface.mesh.triangles.size(), 12U);
  EXPECT_EQ(model.surface.regions.size(), 6U);
  EXPECT_NEAR(model.check.volume_m3, 30, 1e-12);
  const Vec3 middle(3, 2.5, 1.75);
  for (std::size_t t = 0; t < 12; ++t) {
    EXPECT_GT(area_normal(model.surface.mesh, t).dot(model.surface.mesh.corner(t, 0) - middle), 0);
  }
  EXPECT_NEAR(model.areas.floor, 12, 1e-12);
  EXPECT_NEAR(model.areas.wall, 35, 1e-12);
}

TEST(Extract, CoplanarNeighboursOfManyCellsAreMergedIntoOneFace) {
  const CellComplex complex = grid_complex({0, 1, 2, 3, 4, 5, 6}, {0, 1, 2, 3, 4, 5}, {0, 1, 1.5, 2, 3});
  const Model model = extract(
      complex, label_where(complex, [](const Vec2& p, double z) { return within(p, 1, 5, 1, 4) && z > 1; }));
  expect_sound(model);
  EXPECT_EQ(model.surface.mesh.triangles.size(), 12U);  // the ceiling lies on the bounding box
}

TEST(Extract, AnLHasTwentyTriangles) {
  const CellComplex complex = grid_complex({0, 1, 3, 6, 7}, {0, 1, 3, 5, 6}, {0, 1, 3, 4}, 0.3);
  const Model model = extract(complex, label_where(complex, [](const Vec2& p, double z) {
                                const Vec2 q(std::cos(0.3) * p.x() + std::sin(0.3) * p.y(),
                                             -std::sin(0.3) * p.x() + std::cos(0.3) * p.y());
                                return z > 1 && z < 3 && (within(q, 1, 6, 1, 3) || within(q, 1, 3, 1, 5));
                              }));
  expect_sound(model);
  EXPECT_EQ(model.surface.mesh.vertices.size(), 12U);
  EXPECT_EQ(model.surface.mesh.triangles.size(), 20U);
  EXPECT_NEAR(model.check.volume_m3, 2 * 14, 1e-9);
}

TEST(Extract, APillarIsAHoleInFloorAndCeiling) {
  const CellComplex complex = grid_complex({0, 1, 3, 4, 6, 7}, {0, 1, 3, 4, 6, 7}, {0, 1, 4, 5});
  const Model model = extract(complex, label_where(complex, [](const Vec2& p, double z) {
                                return z > 1 && z < 4 && within(p, 1, 6, 1, 6) && !within(p, 3, 4, 3, 4);
                              }));
  expect_sound(model);
  EXPECT_EQ(model.surface.regions.size(), 10U);
  EXPECT_EQ(model.surface.mesh.vertices.size(), 16U);
  EXPECT_EQ(model.check.euler, 0);  // a torus
  EXPECT_NEAR(model.check.volume_m3, 72, 1e-12);
}

TEST(Extract, TwoStoreysWithAShaftAreOneManifoldAndTwoStoreys) {
  const CellComplex complex = grid_complex({0, 1, 4, 6, 9, 10}, {0, 1, 3, 4, 7, 8}, {0, 0.5, 3, 3.3, 6, 7});
  const Labels labels = label_where(complex, [](const Vec2& p, double z) {
    const bool storey = (z > 0.5 && z < 3) || (z > 3.3 && z < 6);
    const bool shaft = within(p, 4, 6, 3, 4) && z > 3 && z < 3.3;
    return (storey && within(p, 1, 9, 1, 7)) || shaft;
  });
  const Model model = extract(complex, labels);
  expect_sound(model);
  EXPECT_EQ(model.check.components, 1);
  EXPECT_NEAR(model.empty_m3, 48 * 2.5 + 48 * 2.7 + 2 * 0.3, 1e-9);
  ASSERT_EQ(model.storeys.size(), 2U);
  EXPECT_NEAR(model.storeys[0].floor_z, 0.5, 1e-12);
  EXPECT_NEAR(model.storeys[1].floor_z, 3.3, 1e-12);
  EXPECT_NEAR(model.storeys[0].area_m2, 48, 1e-9);
  EXPECT_NEAR(model.storeys[1].area_m2, 46, 1e-9);  // the shaft's column belongs to its floor
  EXPECT_EQ(model.rooms.size(), 2U);
}

TEST(Extract, VerticesInTheMiddleOfStraightSidesDisappear) {
  // One room whose plan face has mid-edge vertices from its neighbours.
  const CellComplex complex = grid_complex({0, 1, 2, 3}, {0, 1, 2, 3}, {0, 1, 2, 3}, 0.7,
                                           [](int i, int j) { return i == 0 && j == 1; });
  ASSERT_EQ(complex.corners(3).size(), 6U);  // the joined face: six corners
  const Model model = extract(complex, label_where(complex, [&](const Vec2& p, double z) {
                                return z > 1 && z < 2 && (p - complex.centroid(3)).norm() < 1e-6;
                              }));
  expect_sound(model);
  EXPECT_EQ(model.surface.mesh.triangles.size(), 12U);
}

TEST(Extract, ObjPolygonsCoverTheSameAreaAsTheTriangles) {
  const CellComplex complex = grid_complex({0, 1, 3, 4, 6, 7}, {0, 1, 3, 4, 6, 7}, {0, 1, 4, 5});
  const Model model = extract(complex, label_where(complex, [](const Vec2& p, double z) {
                                return z > 1 && z < 4 && within(p, 1, 6, 1, 6) && !within(p, 3, 4, 3, 4);
                              }));
  double sum = 0;
  std::size_t polygons = 0;
  const auto& points = model.surface.mesh.vertices;
  for (const SurfaceRegion& region : model.surface.regions) {
    for (const auto& polygon : region.polygons) {
      ++polygons;
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {  // the fan that every reader of OBJ makes
        TriangleMesh one;
        one.vertices = {points[polygon[0]], points[polygon[i]], points[polygon[i + 1]]};
        one.triangles = {{0, 1, 2}};
        sum += surface_area(one);
      }
    }
  }
  EXPECT_NEAR(sum, surface_area(model.surface.mesh), 1e-9);
  EXPECT_EQ(polygons, 16U);  // 8 walls, 4 pieces each of the floor and the ceiling
}

TEST(Extract, RoomsTouchingInAnEdgeAreAFaultThatNamesIt) {
  const CellComplex complex = grid_complex({0, 1, 2, 3, 4}, {0, 1, 2, 3, 4}, {0, 1, 2, 3});
  const Model model = extract(complex, label_where(complex, [](const Vec2& p, double z) {
                                return z > 1 && z < 2 && (within(p, 1, 2, 1, 2) || within(p, 2, 3, 2, 3));
                              }));
  EXPECT_NE(model.fault.find("1 edges with more than two triangles"), std::string::npos) << model.fault;
  EXPECT_FALSE(model.surface.mesh.triangles.empty()) << "the evidence is kept";
}

TEST(Extract, AllSolidIsAnErrorNotAnEmptyFile) {
  const CellComplex complex = grid_complex({0, 1, 2}, {0, 1, 2}, {0, 1});
  try {
    extract(complex, label_where(complex, [](const Vec2&, double) { return false; }));
    FAIL();
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems().front().code.id, "N05");
    EXPECT_EQ(error.exit_code(), ExitCode::kNoResult);
  }
}

}  // namespace
}  // namespace roomcut::extract

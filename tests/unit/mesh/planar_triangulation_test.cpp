// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/planar_triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace roomcut {
namespace {

void add_loop(PlanarRegion& region, const std::vector<Vec2>& loop) {
  const auto first = static_cast<std::int32_t>(region.points.size());
  const auto n = static_cast<std::int32_t>(loop.size());
  region.points.insert(region.points.end(), loop.begin(), loop.end());
  for (std::int32_t i = 0; i < n; ++i) {
    region.segments.push_back({first + i, first + (i + 1) % n});
  }
}

double area(const std::vector<Vec2>& points, const std::vector<std::int32_t>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = points[static_cast<std::size_t>(polygon[i])];
    const Vec2& b = points[static_cast<std::size_t>(polygon[(i + 1) % polygon.size()])];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

double area(const PlanarRegion& region, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const double one = area(region.points, {t[0], t[1], t[2]});
    EXPECT_GT(one, 0) << "triangles are counter-clockwise";
    sum += one;
  }
  return sum;
}

TEST(PlanarTriangulation, ASquareWithMidEdgeCornersUsesEachOfThem) {
  PlanarRegion region;
  add_loop(region, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
  std::string why;
  const auto triangles = triangulate(region, why);
  ASSERT_TRUE(triangles) << why;
  EXPECT_EQ(triangles->size(), 6U);
  EXPECT_DOUBLE_EQ(area(region, *triangles), 4);
}

TEST(PlanarTriangulation, AHoleStaysOpenAndAnIslandInItIsFilled) {
  PlanarRegion region;
  add_loop(region, {{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  add_loop(region, {{1, 1}, {1, 9}, {9, 9}, {9, 1}});
  add_loop(region, {{4, 4}, {6, 4}, {6, 6}, {4, 6}});
  std::string why;
  const auto triangles = triangulate(region, why);
  ASSERT_TRUE(triangles) << why;
  EXPECT_DOUBLE_EQ(area(region, *triangles), 100 - 64 + 4);
}

TEST(PlanarTriangulation, LoopsMayTouchInACorner) {
  PlanarRegion region;  // two squares of one region meeting in the corner 2
  region.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 1}, {2, 2}, {1, 2}};
  region.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {2, 4}, {4, 5}, {5, 6}, {6, 2}};
  std::string why;
  const auto triangles = triangulate(region, why);
  ASSERT_TRUE(triangles) << why;
  EXPECT_DOUBLE_EQ(area(region, *triangles), 2);
}

TEST(PlanarTriangulation, CrossingAndOpenBoundariesAreRefusedWithAReason) {
  std::string why;
  PlanarRegion crossing;
  add_loop(crossing, {{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  EXPECT_FALSE(triangulate(crossing, why));
  EXPECT_NE(why.find("cross"), std::string::npos) << why;
  PlanarRegion open;
  open.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  open.segments = {{0, 1}, {1, 2}, {2, 3}};
  EXPECT_FALSE(triangulate(open, why));
  EXPECT_NE(why.find("closed"), std::string::npos) << why;
}

TEST(ConvexPieces, ARectangleWithMidEdgeCornersStaysInStrictlyConvexPieces) {
  PlanarRegion region;
  add_loop(region, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}});
  std::string why;
  const auto triangles = triangulate(region, why);
  ASSERT_TRUE(triangles) << why;
  const auto pieces = convex_pieces(region.points, *triangles);
  EXPECT_EQ(pieces.size(), 2U);
  double sum = 0;
  for (const auto& piece : pieces) {
    sum += area(region.points, piece);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const std::size_t n = piece.size();
      EXPECT_GT(area(region.points, {piece[i], piece[(i + 1) % n], piece[(i + 2) % n]}), 0);
    }
  }
  EXPECT_DOUBLE_EQ(sum, 2);
}

TEST(ConvexPieces, AConvexPolygonBecomesOnePiece) {
  PlanarRegion region;
  std::vector<Vec2> loop;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * std::numbers::pi * i / 24;
    loop.emplace_back(std::cos(angle), std::sin(angle));
  }
  add_loop(region, loop);
  std::string why;
  const auto triangles = triangulate(region, why);
  ASSERT_TRUE(triangles) << why;
  EXPECT_EQ(convex_pieces(region.points, *triangles).size(), 1U);
}

TEST(Projection, KeepsCounterClockwiseForEveryDominantAxis) {
  for (const Vec3& normal :
       {Vec3(1, .2, 0), Vec3(-1, .2, 0), Vec3(.2, 1, 0), Vec3(0, -1, .2), Vec3(0, 0, 1), Vec3(0, .1, -1)}) {
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.normalized().cross(u);
    const Projection projection = project(normal);
    const Vec2 a = projection(u);
    const Vec2 b = projection(v);
    EXPECT_GT(a.x() * b.y() - a.y() * b.x(), 0) << normal.transpose();
  }
}

}  // namespace
}  // namespace roomcut

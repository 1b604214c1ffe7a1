// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/face_locator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "common/random/counter_random.h"
#include "stages/partition/partition.h"
#include "tests/unit/cells/three_faces.h"
#include "tests/unit/partition/random_lines.h"

namespace roomcut {
namespace {

/// How far p lies outside of a face [m]; negative inside.
double outside_of(const CellComplex& complex, std::int32_t face, const Vec2& p) {
  const FaceCorners corners = complex.corners(static_cast<std::size_t>(face));
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 along = (corners.after(i) - corners[i]).normalized();
    farthest = std::max(farthest, along.y() * (p - corners[i]).x() - along.x() * (p - corners[i]).y());
  }
  return farthest;
}

CellComplex random_complex(std::uint64_t seed) {
  const partition::Motion motion{0.3 * static_cast<double>(seed % 5), {100, -40}};
  return partition::partition(partition::random_lines(seed, 12, seed % 2 == 0, motion), {0, 2.5, 2.8, 5.3},
                              {})
      .complex;
}

bool has_edge(const CellComplex& complex, std::int32_t face, std::size_t edge) {
  const auto edges = complex.edges_of(static_cast<std::size_t>(face));
  return std::find(edges.begin(), edges.end(), static_cast<std::int32_t>(edge)) != edges.end();
}

TEST(FaceLocator, FindsTheFaceThatHoldsThePointInAnyComplex) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CellComplex complex = random_complex(seed);
    const FaceLocator locator(complex);
    Eigen::AlignedBox2d box;
    for (const Vec2& vertex : complex.vertices) {
      box.extend(vertex);
    }
    for (std::size_t f = 0; f < complex.faces(); ++f) {
      EXPECT_EQ(locator.face_at(complex.centroid(f)), static_cast<std::int32_t>(f)) << "seed " << seed;
    }
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Vec2 p(100 + 40 * (random_unit(seed, 1, i) - 0.5), -40 + 40 * (random_unit(seed, 2, i) - 0.5));
      const std::int32_t face = locator.face_at(p);
      EXPECT_EQ(face >= 0, box.contains(p)) << "seed " << seed << ", point " << p.transpose();
      if (face >= 0) {
        EXPECT_LT(outside_of(complex, face, p), 1e-9) << "seed " << seed << ", point " << p.transpose();
      }
    }
  }
}

TEST(FaceLocator, GivesPointsOnEdgesAndCornersToAFaceThatTouchesThem) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CellComplex complex = random_complex(seed);
    const FaceLocator locator(complex);
    for (std::size_t e = 0; e < complex.edges.size(); ++e) {
      const Vec2& a = complex.vertices[static_cast<std::size_t>(complex.edges[e].v0)];
      const Vec2& b = complex.vertices[static_cast<std::size_t>(complex.edges[e].v1)];
      const std::int32_t at_middle = locator.face_at(0.5 * (a + b));
      ASSERT_GE(at_middle, 0) << "seed " << seed << ", edge " << e;
      EXPECT_TRUE(has_edge(complex, at_middle, e)) << "seed " << seed << ", edge " << e;
      for (const Vec2& corner : {a, b}) {
        const std::int32_t face = locator.face_at(corner);
        ASSERT_GE(face, 0) << "seed " << seed << ", edge " << e;
        const FaceCorners corners = complex.corners(static_cast<std::size_t>(face));
        EXPECT_NE(std::find(corners.begin(), corners.end(), corner), corners.end()) << "seed " << seed;
      }
    }
  }
}

TEST(FaceLocator, APointOnAnEdgeBelongsToTheFaceRightOfItOrAbove) {
  const CellComplex complex = three_faces();
  const FaceLocator locator(complex);
  EXPECT_EQ(locator.face_at({1, 0.5}), 1);
  EXPECT_EQ(locator.face_at({2, 1}), 2);
  EXPECT_EQ(locator.face_at({1, 1}), 2);
}

TEST(FaceLocator, TheBoxBelongsToThePlanAndNothingBeyondIt) {
  const CellComplex complex = three_faces();
  const FaceLocator locator(complex);
  EXPECT_EQ(locator.face_at({0, 0}), 0);
  EXPECT_EQ(locator.face_at({4, 0.5}), 1);
  EXPECT_EQ(locator.face_at({4, 2}), 2);
  EXPECT_EQ(locator.face_at({0.5, 2}), 0);
  for (const Vec2& p : {Vec2(-1e-9, 1), Vec2(4 + 1e-9, 1), Vec2(1, -1e-9), Vec2(1, 2 + 1e-9), Vec2(1e9, 1),
                        Vec2(std::numeric_limits<double>::quiet_NaN(), 1)}) {
    EXPECT_EQ(locator.face_at(p), -1) << p.transpose();
  }
}

TEST(FaceLocator, CellsBeginAtTheirLowerLevel) {
  const CellComplex complex = three_faces();
  const FaceLocator locator(complex);
  EXPECT_EQ(locator.cell_at({2, 0.5, 0}), static_cast<std::int64_t>(complex.cell(1, 0)));
  EXPECT_EQ(locator.cell_at({2, 0.5, 2.5}), static_cast<std::int64_t>(complex.cell(1, 1)));
  EXPECT_EQ(locator.cell_at({2, 0.5, 3}), -1);
  EXPECT_EQ(locator.cell_at({2, 0.5, -0.1}), -1);
  EXPECT_EQ(locator.cell_at({5, 0.5, 1}), -1);
}

}  // namespace
}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/creases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/cells/stairs.h"
#include "stages/partition/partition.h"
#include "tests/unit/partition/random_lines.h"

namespace roomcut::partition {
namespace {

SlopedPlane plane(const Vec2& gradient, const Vec2& through, double z, std::vector<Vec2> outline) {
  SlopedPlane made;
  made.gradient = gradient;
  made.c = z - gradient.dot(through);
  made.outline = std::move(outline);
  return made;
}

std::vector<Vec2> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// Corners of the face drawn a little towards its middle: those on a crease lie on neither side.
std::vector<Vec2> inner_corners(const CellComplex& complex, std::size_t face) {
  const Vec2 middle = complex.centroid(face);
  std::vector<Vec2> corners;
  for (const Vec2& p : complex.corners(face)) corners.push_back(middle + (1 - 1e-3) * (p - middle));
  return corners;
}

WallLines box(double x, double y) {
  WallLines lines;
  lines.bbox_max = {x, y};
  for (const auto& [a, b] :
       {std::pair<Vec2, Vec2>{{0, 0}, {x, 0}}, {{0, y}, {x, y}}, {{0, 0}, {0, y}}, {{x, 0}, {x, y}}}) {
    WallLine wall;
    wall.id = "w" + std::to_string(lines.lines.size());
    wall.a = a;
    wall.b = b;
    wall.support_m = wall.length();
    lines.lines.push_back(wall);
  }
  return lines;
}

// A gable over 10 m x 8 m: eaves at 2 m, ridge along y at x = 5, 4.5 m high; floor 0, attic floor 3.
const std::vector<double> kLevels{0, 3, 3.5, 4.1, 5};
const Slopes kGable{{plane({0.5, 0}, {0, 0}, 2, rectangle(0.2, 0.2, 4.9, 7.8)),
                     plane({-0.5, 0}, {10, 0}, 2, rectangle(5.1, 0.2, 9.8, 7.8))},
                    {0, 0, 1, 1, 0}};

TEST(Creases, OfAGableAreItsRidgeItsKneesAndOneRiserOnEachSide) {
  const CellComplex complex = partition(box(10, 8), kLevels, {}, kGable).complex;
  ASSERT_EQ(find_violation(complex), "");
  std::vector<double> knees, ridges, risers;
  for (const CellComplex::Line& line : complex.lines) {
    if (line.plane < 0) continue;
    const double x = line.line.at(0.5 * (line.t0 + line.t1)).x();
    EXPECT_NEAR(line.t1 - line.t0, 8.2, 0.61);
    const double z = complex.planes[static_cast<std::size_t>(line.plane)].height({x, 4});
    (line.rises(2) ? risers : std::abs(z - 3) < 1e-9 ? knees : ridges).push_back(x);
  }
  const auto sorted = [](std::vector<double> x) {
    std::sort(x.begin(), x.end());
    return x;
  };
  ASSERT_EQ(ridges.size(), 1U);
  EXPECT_NEAR(ridges[0], 5, 1e-9);
  ASSERT_EQ(knees.size(), 2U);
  EXPECT_NEAR(sorted(knees)[0], 2, 1e-9);
  EXPECT_NEAR(sorted(knees)[1], 8, 1e-9);
  ASSERT_EQ(risers.size(), 2U);
  EXPECT_NEAR(sorted(risers)[0], 3.6, 1e-9);  // 3.8 m, half way between the steps
  EXPECT_NEAR(sorted(risers)[1], 6.4, 1e-9);
}

TEST(Creases, CarryNoWallAndAreNoLinesWithoutAnEdge) {
  const Partition result = partition(box(10, 8), kLevels, {}, kGable);
  EXPECT_TRUE(result.without_edge.empty());
  for (const CellComplex::Line& line : result.complex.lines) {
    for (std::size_t k = 0; k < result.complex.layers(); ++k) {
      EXPECT_EQ(line.carries(k), line.plane < 0);
    }
  }
}

TEST(Creases, OnePassingBesideAWallIsLeftOut) {
  WallLines lines = box(10, 8);
  lines.lines[0].a = {5.02, -1};
  lines.lines[0].b = {5.02, 9};
  lines.lines[0].support_m = 10;
  const CellComplex complex = partition(lines, kLevels, {}, kGable).complex;
  for (const CellComplex::Line& line : complex.lines) {
    if (line.plane >= 0) {
      EXPECT_GT(std::abs(line.line.at(0.5 * (line.t0 + line.t1)).x() - 5), 0.5);
    }
  }
}

// What the cells are made for: inside a face, between the footprints' rims, no two surfaces change places.
TEST(Creases, OrderTheSurfacesOfEveryColumn) {
  std::mt19937 draw(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::size_t looked_at = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    WallLines lines = random_lines(seed, 5 + static_cast<int>(seed % 20), seed % 2 == 0);
    Slopes slopes{{}, {0, 1, 1, 0, 0, 1, 0}};
    const std::vector<double> levels{0, 0.8, 1.7, 2.5, 2.8, 4.0, 5.3};
    const Vec2 low = lines.bbox_min, size = lines.bbox_max - lines.bbox_min;
    for (int i = 0; i < 3; ++i) {
      const double pitch = 0.02 + 1.2 * unit(draw), azimuth = 6.28 * unit(draw);
      const Vec2 middle = low + Vec2(unit(draw) * size.x(), unit(draw) * size.y());
      slopes.planes.push_back(plane(pitch * Vec2(std::cos(azimuth), std::sin(azimuth)), middle,
                                    5 * unit(draw),
                                    rectangle(low.x(), low.y(), low.x() + size.x(), low.y() + size.y())));
    }
    const CellComplex complex = partition(lines, levels, {}, slopes).complex;
    ASSERT_EQ(find_violation(complex), "") << "seed " << seed;
    const Stairs stairs(complex.levels, complex.steps);
    for (std::size_t face = 0; face < complex.faces(); ++face) {
      const std::vector<Vec2> corners = inner_corners(complex, face);
      const bool inside = std::all_of(corners.begin(), corners.end(),
                                      [&](const Vec2& p) { return complex.planes[0].covers(p, 0); });
      if (!inside || complex.area(face) < 0.2) continue;  // beside near lines a crease is left out
      ++looked_at;
      for (const SlopedPlane& p : complex.planes) {
        const std::size_t level = stairs.level_of(p.height(complex.centroid(face)));
        for (const Vec2& corner : corners) {
          const double z = p.height(corner);
          const bool same = stairs.level_of(z - 0.08) == level || stairs.level_of(z + 0.08) == level;
          EXPECT_TRUE(same) << "seed " << seed << " face " << face << " height " << z;
        }
      }
    }
  }
  EXPECT_GT(looked_at, 1000U);
}

}  // namespace
}  // namespace roomcut::partition

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/partition.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/errors/codes.h"
#include "tests/unit/partition/random_lines.h"

namespace roomcut::partition {
namespace {

const std::vector<double> kLevels{0, 2.5, 2.8, 5.3};

PartitionParams unbounded() {
  PartitionParams params;
  params.extend_m = 1e4;
  return params;
}

WallLine wall(const char* id, Vec2 a, Vec2 b) {
  WallLine line;
  line.id = id;
  line.a = a;
  line.b = b;
  line.support_m = line.length();
  return line;
}

WallLines box_of(std::vector<WallLine> walls) {
  WallLines lines;
  lines.bbox_min = {0, 0};
  lines.bbox_max = {10, 8};
  lines.lines = std::move(walls);
  return lines;
}

double total_area(const CellComplex& complex) {
  double area = 0;
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    area += complex.area(f);
  }
  return area;
}

TEST(Partition, AnyLinesGiveAValidComplexHoweverTheyLie) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const bool nasty = seed % 4 != 0;
    for (const Motion& motion :
         {Motion{}, Motion{0.7, {0, 0}}, Motion{1e-6, {0, 0}}, Motion{2.5, {800.3, -433.7}}}) {
      const WallLines lines = random_lines(seed, 5 + static_cast<int>(seed % 40), nasty, motion);
      for (const PartitionParams& params : {PartitionParams{}, unbounded()}) {
        const Partition result = partition(lines, kLevels, params);
        ASSERT_EQ(find_violation(result.complex), "") << "seed " << seed << ", turned by " << motion.angle;
        EXPECT_TRUE(nasty || result.without_edge.empty());
      }
    }
  }
}

TEST(Partition, AShortLineCutsNoFartherThanItIsLong) {
  const auto faces = [](double length) {
    return partition(box_of({wall("w1", {0, 4}, {10, 4}), wall("w2", {5, 3.4 - length}, {5, 3.4})}), {0, 2.5},
                     {})
        .complex.faces();
  };
  EXPECT_EQ(faces(0.6), 4U);  // into the upper half, too
  EXPECT_EQ(faces(0.3), 3U);
}

TEST(Partition, NumbersOfFacesDoNotDependOnWhereTheBuildingStands) {
  // The bounding box of a turned plan is another one, so lines are compared that end at a quarter turn.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::size_t faces = partition(random_lines(seed, 40, false), kLevels, {}).complex.faces();
    const Motion far{0, {-712.25, 1033.5}};
    const Motion quarter{1.5707963267948966, {3, 0}};
    EXPECT_EQ(partition(random_lines(seed, 40, false, far), kLevels, {}).complex.faces(), faces);
    EXPECT_EQ(partition(random_lines(seed, 40, false, quarter), kLevels, {}).complex.faces(), faces);
  }
}

TEST(Partition, UnboundedLinesInGeneralPositionGiveEulersNumberOfFaces) {
  // An arrangement of full lines has 1 + lines + crossings faces; crossings counted in the box, pair by pair.
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const WallLines lines = random_lines(seed, 30, false, {0.3, {0, 0}});
    const CellComplex complex = partition(lines, kLevels, unbounded()).complex;
    Vec2 box_low = complex.vertices[0];
    Vec2 box_high = complex.vertices[0];
    for (const Vec2& p : complex.vertices) {
      box_low = box_low.cwiseMin(p);
      box_high = box_high.cwiseMax(p);
    }
    std::size_t crossings = 0;
    for (std::size_t i = 0; i < lines.lines.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Line2& a = complex.lines[i].line;
        const Line2& b = complex.lines[j].line;
        const double slope = a.normal().dot(b.direction());
        if (std::abs(slope) > 1e-9) {
          const Vec2 p = b.at((a.d - a.normal().dot(b.at(0))) / slope);
          crossings += (p.array() > box_low.array()).all() && (p.array() < box_high.array()).all() ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(complex.faces(), 1 + lines.lines.size() + crossings);
  }
}

TEST(Partition, FacesFillTheBoxAroundScanAndLinesWithItsMargin) {
  const WallLines lines = box_of({wall("w1", {2, 1}, {2, 12}), wall("w2", {1, 3}, {9, 3})});
  const Partition result = partition(lines, kLevels, {});
  EXPECT_NEAR(total_area(result.complex), 11.0 * 13.0, 1e-9);
  EXPECT_EQ(result.complex.layers(), 3U);
  EXPECT_EQ(result.complex.cells(), 3 * result.complex.faces());
}

TEST(Partition, AShortLineCutsNoFaceBeyondItsReach) {
  const WallLines lines =
      box_of({wall("w1", {0, 4}, {10, 4}), wall("w2", {5, 0}, {5, 8}), wall("w3", {1, 6}, {2, 6})});
  const CellComplex complex = partition(lines, kLevels, {}).complex;
  EXPECT_EQ(complex.faces(), 5U);  // w3 stays left of w2
  for (const CellComplex::Edge& edge : complex.edges) {
    if (edge.line == 2) {
      EXPECT_LE(complex.vertices[edge.v0].x(), 5 + 1e-9);
    }
  }
}

TEST(Partition, TheSameLinesInAnotherOrderGiveTheSameComplex) {
  WallLines lines = random_lines(5, 30, true);
  const CellComplex first = partition(lines, kLevels, {}).complex;
  const CellComplex again = partition(lines, kLevels, {}).complex;
  EXPECT_EQ(first.face_vertex, again.face_vertex);
  std::reverse(lines.lines.begin(), lines.lines.end());
  const CellComplex turned = partition(lines, kLevels, {}).complex;
  EXPECT_EQ(first.vertices, turned.vertices);
  EXPECT_EQ(first.face_vertex, turned.face_vertex);
}

TEST(Partition, KeepsTheLayersOfALineAndRefusesOnesThatAreNotThere) {
  WallLines lines = box_of({wall("w1", {2, 1}, {2, 7})});
  lines.lines[0].levels = std::vector<int>{2, 0, 2};
  EXPECT_EQ(partition(lines, kLevels, {}).complex.lines[0].layers, (std::vector<std::int32_t>{0, 2}));
  lines.lines[0].levels = std::vector<int>{3};
  try {
    partition(lines, kLevels, {});
    FAIL() << "took a wall slice that is not there";
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems()[0].code.id, errors::kLinesProperty.id);
  }
}

TEST(Partition, GivesUpWithoutLinesAndBeyondTheBudget) {
  EXPECT_THROW(partition(box_of({}), kLevels, {}), StageError);
  PartitionParams params;
  params.max_cells = 30;
  try {
    partition(random_lines(1, 60, false), kLevels, params);
    FAIL() << "went beyond the budget";
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems()[0].code.id, errors::kTooComplex.id);
  }
}

}  // namespace
}  // namespace roomcut::partition

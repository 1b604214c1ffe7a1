// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/prune.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "stages/partition/partition.h"
#include "tests/unit/partition/random_lines.h"

namespace roomcut {
namespace {

const std::vector<double> kLevels{0, 2.5};

WallLine wall(const char* id, Vec2 a, Vec2 b) {
  WallLine line;
  line.id = id;
  line.a = a;
  line.b = b;
  line.support_m = line.length();
  return line;
}

CellComplex cut(std::vector<WallLine> walls, bool prune) {
  WallLines lines;
  lines.bbox_min = {0, 0};
  lines.bbox_max = {20, 8};
  lines.lines = std::move(walls);
  PartitionParams params;
  params.extend_m = 1;
  params.prune = prune;
  return partition(lines, kLevels, params).complex;
}

double length_on_line(const CellComplex& complex, std::int32_t line) {
  double length = 0;
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    length += complex.edges[e].line == line ? complex.length(e) : 0;
  }
  return length;
}

TEST(Prune, AStrongLineEndsAtTheNextLineBeyondItsReach) {
  // The strongest line is cut in first and runs through the whole box, 21 m; its reach ends at x = 9, the
  // next line is x = 12.
  const std::vector<WallLine> walls{wall("w1", {0, 4}, {8, 4}), wall("w2", {12, 1}, {12, 7}),
                                    wall("w3", {16, 1}, {16, 7})};
  EXPECT_NEAR(length_on_line(cut(walls, false), 0), 21, 1e-9);
  const CellComplex complex = cut(walls, true);
  EXPECT_NEAR(length_on_line(complex, 0), 12.5, 1e-9);
  EXPECT_EQ(complex.faces(), 4U);
  EXPECT_EQ(find_violation(complex), "");
  // Vertices where only the pruned part crossed are gone.
  for (const Vec2& p : complex.vertices) {
    EXPECT_GT((p - Vec2(16, 4)).norm(), 0.1);
    EXPECT_GT((p - Vec2(20.5, 4)).norm(), 0.1);
  }
}

TEST(Prune, KeepsEveryEdgeWithinItsLinesReach) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const WallLines lines = random_lines(seed, 40, false, {0.4, {3, 3}});
    PartitionParams params;
    params.prune = false;
    const CellComplex whole = partition(lines, kLevels, params).complex;
    params.prune = true;
    const CellComplex pruned = partition(lines, kLevels, params).complex;
    ASSERT_EQ(find_violation(pruned), "");
    EXPECT_LT(pruned.faces(), whole.faces());
    for (std::size_t i = 0; i < whole.lines.size(); ++i) {
      const auto within = [&](const CellComplex& complex) {
        double length = 0;
        for (const CellComplex::Edge& edge : complex.edges) {
          if (edge.line == static_cast<std::int32_t>(i)) {
            const double a = complex.lines[i].line.along(complex.vertices[edge.v0]);
            const double b = complex.lines[i].line.along(complex.vertices[edge.v1]);
            length += std::max(0.0, std::min(std::max(a, b), complex.lines[i].t1 + params.extend_m) -
                                        std::max(std::min(a, b), complex.lines[i].t0 - params.extend_m));
          }
        }
        return length;
      };
      EXPECT_NEAR(within(pruned), within(whole), 1e-9);
    }
  }
}

TEST(Prune, TwoWallsInOneRowBothKeepTheirEdges) {
  // The same carrier but for the rounding of 6 decimals; the stronger line is cut in first and runs through
  // the weaker.
  const std::vector<WallLine> walls{wall("w1", {1, 4}, {9, 4.000002}),
                                    wall("w2", {14, 4.000003}, {18, 4.000004}),
                                    wall("w3", {10.5, 1}, {10.5, 7}), wall("w4", {12.5, 1}, {12.5, 7})};
  const CellComplex complex = cut(walls, true);
  EXPECT_EQ(find_violation(complex), "");
  EXPECT_NEAR(length_on_line(complex, 0), 11, 1e-5);  // from the box to w3
  EXPECT_NEAR(length_on_line(complex, 1), 8, 1e-5);   // from w4 to the box
  EXPECT_EQ(complex.faces(), 5U);
}

double faces_of_copies(const WallLines& one, int copies) {
  WallLines row = one;
  row.lines.clear();
  for (int i = 0; i < copies; ++i) {
    for (WallLine line : one.lines) {
      line.id += "_" + std::to_string(i);
      line.a.x() += 32 * i;
      line.b.x() += 32 * i;
      row.lines.push_back(line);
    }
  }
  row.bbox_max.x() += (copies - 1) * 32;
  return static_cast<double>(partition(row, kLevels, {}).complex.faces());
}

TEST(Prune, CellsGrowInProportionWhenABuildingStandsSeveralTimes) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const WallLines one = random_lines(seed, 60, false);
    const double two = faces_of_copies(one, 2);
    const double eight = faces_of_copies(one, 8);
    EXPECT_LE(eight, 1.03 * 8 * faces_of_copies(one, 1));  // the gaps between the copies are faces too
    EXPECT_NEAR(faces_of_copies(one, 32) - eight, 4 * (eight - two), 0.005 * eight);
  }
}

}  // namespace
}  // namespace roomcut

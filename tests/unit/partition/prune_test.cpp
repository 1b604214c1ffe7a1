// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/prune.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "stages/partition/dent.h"
#include "stages/partition/partition.h"
#include "tests/unit/partition/random_lines.h"
#include "tests/unit/partition/short_lines.h"

namespace roomcut::partition {
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
    EXPECT_EQ(find_violation(pruned), "");
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

/// Whether p lies in the face, or within 1e-9 m of it.
bool holds(const CellComplex& complex, std::size_t face, const Vec2& p) {
  const FaceCorners corners = complex.corners(face);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& from = corners[i];
    const Vec2 side = corners.after(i) - from;
    if (side.x() * (p - from).y() - side.y() * (p - from).x() < -1e-9 * std::max(1.0, side.norm())) {
      return false;
    }
  }
  return true;
}

/// Faces of `whole` that no face of `pruned` holds with all their corners.
std::size_t torn_faces(const CellComplex& whole, const CellComplex& pruned) {
  std::size_t torn = 0;
  for (std::size_t f = 0; f < whole.faces(); ++f) {
    bool held = false;
    for (std::size_t g = 0; g < pruned.faces() && !held; ++g) {
      const FaceCorners corners = whole.corners(f);
      held = std::all_of(corners.begin(), corners.end(), [&](const Vec2& p) { return holds(pruned, g, p); });
    }
    torn += held ? 0 : 1;
  }
  return torn;
}

TEST(Prune, ShortLinesOfEveryKindGiveAValidComplexWhosePrunedFacesAreUnionsOfTheOthers) {
  std::size_t merged = 0;
  for (const ShortLines family : kShortLineFamilies) {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      const int count = seed % 8 == 0 ? 100 : 4 + static_cast<int>(seed % 4) * 10;
      const WallLines lines = short_lines(family, seed, count);
      PartitionParams params;
      params.extend_m = seed % 3 == 0 ? 0.5 : 2 * static_cast<double>(seed % 3 - 1);
      params.prune = false;
      const CellComplex whole = partition(lines, kLevels, params).complex;
      params.prune = true;
      const CellComplex pruned = partition(lines, kLevels, params).complex;
      ASSERT_EQ(find_violation(whole), "") << "family " << static_cast<int>(family) << ", seed " << seed;
      ASSERT_EQ(find_violation(pruned), "") << "family " << static_cast<int>(family) << ", seed " << seed;
      if (count < 40) {
        ASSERT_EQ(torn_faces(whole, pruned), 0U) << static_cast<int>(family) << ", seed " << seed;
      }
      merged += whole.faces() - pruned.faces();
    }
  }
  EXPECT_GT(merged, 5000U);
}

TEST(Prune, AChordThatEndsBesideItsLineGivesNoFaceThatIsNotConvex) {
  // The first sets of their families, of 72,000, where corners alone were not enough to tell.
  for (const auto& [family, seed, count] :
       {std::tuple(ShortLines::kCollinear, 129, 30), std::tuple(ShortLines::kColumns, 47, 100)}) {
    PartitionParams params;
    params.extend_m = 0.5;
    EXPECT_EQ(find_violation(partition(short_lines(family, seed, count), kLevels, params).complex), "");
  }
}

TEST(Prune, ASideOfMicrometresThatTurnsOutwardsStaysWhenTheLongSideBeyondItWouldNotFit) {
  // The chord 0 - 1 ends 4 um beside the line of the sides 1 - 2 - 3: over 50 um that turn is nothing, over
  // 12 m it is.
  const std::vector<Vec2> near{{0, 0}, {4e-6, -6}, {4e-6, -6.00005}, {3, -3}};
  const std::vector<Vec2> far{{0, 0}, {-4e-6, -6}, {0, -18}, {3, -3}};
  EXPECT_EQ(dent(far), 0);
  EXPECT_NEAR(dent(near), 4e-6 - 4e-6 * 6 / 6.00005, 1e-11);
  std::vector<Vec2> joined{{0, 0}, {4e-6, -6}, {4e-6, -6.00005}, {4e-6, -18}, {30, -3}};
  EXPECT_NEAR(dent(joined), 4e-6 * 12 / 18, 1e-9);
  std::rotate(joined.begin(), joined.begin() + 2, joined.end());
  EXPECT_NEAR(dent(joined), 4e-6 * 12 / 18, 1e-9);  // wherever the corners begin
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
}  // namespace roomcut::partition

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/columns.h"

#include <gtest/gtest.h>

#include "tests/unit/mesh/shapes.h"

namespace roomcut::evaluate {
namespace {

using test::append;
using test::box;

TEST(Columns, ALineThroughABoxEntersAndLeaves) {
  const TriangleMesh mesh = box({0, 0, 1}, {2, 2, 4});
  const Columns columns(mesh);
  std::vector<Crossing> crossings;
  columns.crossings(0.3, 1.1, crossings);
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_DOUBLE_EQ(crossings[0].z, 1);
  EXPECT_EQ(crossings[0].step, 1);
  EXPECT_DOUBLE_EQ(crossings[1].z, 4);
  EXPECT_EQ(crossings[1].step, -1);
  columns.crossings(2.5, 1, crossings);
  EXPECT_TRUE(crossings.empty());
}

TEST(Columns, LinesThroughEdgesAndCornersCrossAnEvenNumberOfTimes) {
  TriangleMesh mesh = box({0, 0, 0}, {2, 2, 1});
  append(mesh, box({2, 0, 2}, {4, 2, 3}));
  const Columns columns(mesh);
  std::vector<Crossing> crossings;
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= 4; ++j) {  // diagonals, sides, corners
      columns.crossings(0.5 * i, 0.5 * j, crossings);
      int sum = 0;
      for (const Crossing& crossing : crossings) sum += crossing.step;
      EXPECT_EQ(sum, 0) << i << ", " << j;
      EXPECT_LE(crossings.size(), 2U) << "only one of two neighbours is met";
    }
  }
}

TEST(Columns, TellsWhichBodyEnclosesAPlace) {
  TriangleMesh mesh = box({0, 0, 0}, {2, 2, 1});
  append(mesh, box({0, 0, 2}, {2, 2, 3}));
  const Columns columns(mesh);
  EXPECT_EQ(columns.component_at({1, 0.7, 0.5}), 0);
  EXPECT_EQ(columns.component_at({1, 0.7, 2.5}), 1);
  EXPECT_EQ(columns.component_at({1, 0.7, 1.5}), -1);
  EXPECT_TRUE(columns.inside({1, 0.7, 0.5}));
  EXPECT_FALSE(columns.inside({1, 0.7, 1.5}));
  EXPECT_FALSE(columns.inside({5, 5, 0.5}));
}

TEST(Columns, OverlappingBodiesCountOnce) {
  TriangleMesh mesh = box({0, 0, 0}, {2, 2, 2});
  append(mesh, box({0, 0, 1}, {2, 2, 3}));
  const Columns columns(mesh);
  std::vector<Crossing> crossings;
  std::vector<Interval> parts;
  columns.crossings(0.9, 0.4, crossings);
  enclosed(crossings, -1, parts);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_DOUBLE_EQ(total_length(parts), 3);
  enclosed(crossings, 1, parts);
  EXPECT_DOUBLE_EQ(total_length(parts), 2);
}

TEST(Columns, OverlapOfIntervalLists) {
  EXPECT_DOUBLE_EQ(overlap({{0, 1}, {2, 4}}, {{0.5, 3}}), 1.5);
  EXPECT_DOUBLE_EQ(overlap({{0, 1}}, {{1, 2}}), 0);
  EXPECT_DOUBLE_EQ(overlap({}, {{1, 2}}), 0);
}

TEST(Intervals, AreUnitedWhereTheyMeetAndSubtractedInAllPositions) {
  const auto pairs = [](const std::vector<Interval>& intervals) {
    std::vector<std::pair<double, double>> out;
    for (const Interval& i : intervals) out.emplace_back(i.lo, i.hi);
    return out;
  };
  using Pairs = std::vector<std::pair<double, double>>;
  std::vector<Interval> some = {{4, 5}, {0, 1}, {1, 2}, {0.5, 0.7}};
  unite(some);
  EXPECT_EQ(pairs(some), (Pairs{{0, 2}, {4, 5}}));
  std::vector<Interval> left;
  subtract({{0, 2}, {3, 6}, {7, 8}}, {{-1, 0.5}, {1, 1.5}, {1.8, 4}, {5, 5.5}, {6.5, 9}}, left);
  EXPECT_EQ(pairs(left), (Pairs{{0.5, 1}, {1.5, 1.8}, {4, 5}, {5.5, 6}}));
  subtract({{0, 2}}, {}, left);
  EXPECT_EQ(pairs(left), (Pairs{{0, 2}}));
}

}  // namespace
}  // namespace roomcut::evaluate

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/compare/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/geometry/scan_coordinates.h"
#include "tests/unit/compare/square_run.h"

namespace roomcut::compare {
namespace {

TEST(MatchLines, ids_and_the_order_of_ends_mean_nothing) {
  const std::vector<WallLine> a = {wall("w0001", {0, 0}, {5, 0}), wall("w0002", {0, 3}, {5, 3})};
  const std::vector<WallLine> b = {wall("w0001", {5, 3}, {0, 3}), wall("w0009", {5, 0}, {0, 0})};
  const LineMatches matches = match_lines(a, b);
  EXPECT_EQ(matches.same(), 2U);
  ASSERT_EQ(matches.pairs.size(), 2U);
  for (const LinePair& pair : matches.pairs) {
    EXPECT_NE(pair.a, pair.b);
  }
}

TEST(MatchLines, the_two_faces_of_a_wall_keep_their_partners) {
  const std::vector<WallLine> a = {wall("w0001", {0, 0}, {5, 0}), wall("w0002", {0, 0.12}, {5, 0.12})};
  const std::vector<WallLine> b = {wall("w0001", {0, 0.1}, {5, 0.1}), wall("w0002", {0, -0.02}, {5, -0.02})};
  const LineMatches matches = match_lines(a, b);
  ASSERT_EQ(matches.pairs.size(), 2U);
  for (const LinePair& pair : matches.pairs) {
    EXPECT_NE(pair.a, pair.b);
    EXPECT_NEAR(pair.move.offset_m, 0.02, 1e-12);
  }
}

TEST(MatchLines, what_moved_most_comes_first) {
  const std::vector<WallLine> a = {wall("w0001", {0, 0}, {5, 0}), wall("w0002", {0, 3}, {5, 3})};
  const std::vector<WallLine> b = {wall("w0001", {0, 0.01}, {5, 0.01}), wall("w0002", {0, 3.2}, {5, 3.2})};
  const LineMatches matches = match_lines(a, b);
  ASSERT_EQ(matches.pairs.size(), 2U);
  EXPECT_EQ(matches.pairs[0].a, 1U);
  EXPECT_NEAR(matches.pairs[0].move.offset_m, 0.2, 1e-12);
  EXPECT_EQ(matches.same(), 0U);
}

TEST(MatchLines, lines_too_far_too_turned_or_not_beside_each_other_are_not_the_same) {
  const std::vector<WallLine> a = {wall("w0001", {0, 0}, {5, 0})};
  for (const WallLine& other : {wall("w0001", {0, 0.31}, {5, 0.31}), wall("w0001", {0, -0.25}, {5, 0.25}),
                                wall("w0001", {3.5, 0}, {8.5, 0})}) {
    const LineMatches matches = match_lines(a, {other});
    EXPECT_TRUE(matches.pairs.empty());
    EXPECT_EQ(matches.only_a.size(), 1U);
    EXPECT_EQ(matches.only_b.size(), 1U);
  }
  EXPECT_EQ(match_lines(a, {wall("w0001", {3.2, 0}, {8.2, 0})}).pairs.size(), 1U);
}

TEST(MatchRooms, by_place_and_floor_whatever_their_numbers) {
  std::vector<SpaceFacts> a = square_run("a", 6).rooms;
  std::vector<SpaceFacts> b = a;
  b.insert(b.begin(), SpaceFacts{0, 1, a[0].centre, 3, 6, 1, 1, 1, 0});  // the room above
  b[1].number = 1;
  const Matches matches = match_rooms(a, b);
  ASSERT_EQ(matches.both.size(), 1U);
  EXPECT_EQ(matches.both[0].second, 1U);
  EXPECT_EQ(matches.only_b, std::vector<std::size_t>{0});
}

TEST(CompareRuns, a_run_and_itself_do_not_differ) {
  const RunFacts run = square_run("a", 6);
  const Comparison comparison = compare_runs(run, run);
  EXPECT_TRUE(comparison.same_scan);
  EXPECT_TRUE(comparison.parameters.empty());
  EXPECT_EQ(comparison.lines.same(), 4U);
  EXPECT_TRUE(comparison.lines.only_a.empty() && comparison.lines.only_b.empty());
  EXPECT_TRUE(comparison.rooms.only_a.empty() && comparison.storeys.only_a.empty());
}

TEST(CompareRuns, parameters_that_differ_or_that_one_run_does_not_know_are_listed) {
  const RunFacts a = square_run("a", 6);
  RunFacts b = a;
  b.parameters = {{"graphcut.mu_m", "0.5"}, {"extract.new", "1"}};
  const auto parameters = compare_runs(a, b).parameters;
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[0].parameter + parameters[0].a + parameters[0].b, "graphcut.mu_m0.30.5");
  EXPECT_EQ(parameters[1].parameter + parameters[1].a + parameters[1].b, "extract.new1");
}

TEST(CompareRuns, a_levelled_run_and_one_that_is_not_are_compared_in_the_same_axes) {
  const RunFacts a = square_run("a", 6);
  RunFacts b = a;
  b.frame.level[0] = 0.08;  // 4.6 degrees
  b.frame.level[2] = std::sqrt(1 - 0.0064);
  const ScanCoordinates scan(b.frame);
  for (WallLine& line : b.lines) {
    line.a = scan.plan_to_local(line.a);
    line.b = scan.plan_to_local(line.b);
  }
  EXPECT_EQ(compare_runs(a, b).lines.same(), 4U);
  EXPECT_LT((lines_in(b, a.frame)[0].a - a.lines[0].a).norm(), 1e-9);
  EXPECT_GT((b.lines[0].b - a.lines[0].b).norm() + (b.lines[0].a - a.lines[0].a).norm(), 0.01);
}

TEST(CompareRuns, scans_with_different_origins_are_compared_by_their_coordinates) {
  const RunFacts a = square_run("a", 6);
  RunFacts b = a;
  b.frame.origin[0] = 100;
  for (WallLine& line : b.lines) {
    line.a.x() -= 100;
    line.b.x() -= 100;
  }
  EXPECT_EQ(compare_runs(a, b).lines.same(), 4U);
}

}  // namespace
}  // namespace roomcut::compare

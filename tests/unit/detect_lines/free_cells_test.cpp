// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/free_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "common/random/counter_random.h"
#include "tests/unit/detect_lines/cells_on_a_line.h"

namespace roomcut::detect_lines {
using namespace roomcut::testing;

namespace {

using testing::add_cells;
using testing::all_of;
using testing::kRules;

/// Walls in all directions, far from the origin, some of them clutter.
WallCells many_walls() {
  WallCells cells;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const double theta = std::numbers::pi * random_unit(5, i, 0);
    const Vec2 middle{700 + 40 * random_unit(5, i, 1), -300 + 25 * random_unit(5, i, 2)};
    const Line2 line{theta, Line2{theta, 0}.normal().dot(middle)};
    const double t = line.along(middle);
    add_cells(cells, line, t - 2, t + 3, 0.01);
  }
  for (std::size_t i = 0; i < cells.size(); i += 7) cells.boundary[i] = 0;
  return cells;
}

TEST(FreeCells, OnALineAreThoseThatASearchOfAllFinds) {
  const WallCells cells = many_walls();
  CellIndices all;
  for (const std::uint32_t i : all_of(cells)) {
    if (cells.boundary[i] != 0) all.push_back(i);
  }
  FreeCells free(cells);
  for (std::uint64_t i = 0; i < 200; ++i) {
    // Upright and level lines, and any other.
    const double theta =
        i % 4 < 2 ? static_cast<double>(i % 4) * std::numbers::pi / 2 : 3.14 * random_unit(5, i, 3);
    const std::uint32_t on =
        all[static_cast<std::size_t>(random_unit(5, i, 4) * static_cast<double>(all.size() - 1))];
    const Line2 line{theta, Line2{theta, 0}.normal().dot(Vec2{cells.x[on], cells.y[on]})};
    const CellIndices expected = inliers(cells, all, line, kRules, 0.05);
    ASSERT_EQ(free.on_line(line, kRules, 0.05), expected);
    free.take(expected);
    CellIndices left;
    std::set_difference(all.begin(), all.end(), expected.begin(), expected.end(), std::back_inserter(left));
    all.swap(left);
    ASSERT_TRUE(free.on_line(line, kRules, 0.05).empty());
  }
}

TEST(FreeCells, NoCellsAtAllAreNoneOnAnyLine) {
  const WallCells none;
  EXPECT_TRUE(FreeCells(none).on_line({0.3, 1}, kRules, 0.05).empty());
}

}  // namespace
}  // namespace roomcut::detect_lines

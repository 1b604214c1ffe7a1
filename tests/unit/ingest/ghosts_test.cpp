// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/ghosts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "stages/ingest/fixed_grid.h"

namespace roomcut::ingest {
namespace {

CellCount cell(std::uint32_t ix, std::uint32_t iy, std::uint32_t layer, std::uint64_t points) {
  return {iy * fixed_grid::kWindowTiles + ix, layer, points};
}

std::uint64_t kept_points(const std::vector<CellCount>& cells) {
  std::uint64_t sum = 0;
  for (const KeptTile& tile : without_ghosts(cells).tiles) {
    sum += tile.points;
  }
  return sum;
}

/// A building of 4 × 4 tiles and two layers, 10,000 points in each cell.
std::vector<CellCount> building() {
  std::vector<CellCount> cells;
  for (std::uint32_t i = 0; i < 32; ++i) {
    cells.push_back(cell(500 + i % 4, 500 + i / 4 % 4, 30 + i / 16, 10'000));
  }
  return cells;
}

TEST(WithoutGhosts, keeps_a_building_whole) {
  EXPECT_EQ(kept_points(building()), 320'000U);
}

TEST(WithoutGhosts, drops_sparse_far_cells_in_plan_and_in_height) {
  std::vector<CellCount> cells = building();
  cells.push_back(cell(600, 500, 30, 7));
  cells.push_back(cell(410, 450, 30, 30));
  cells.push_back(cell(501, 501, 60, 3));
  cells.push_back(cell(501, 501, 2, 50));
  EXPECT_EQ(kept_points(cells), 320'000U);
}

TEST(WithoutGhosts, keeps_sparse_cells_beside_the_building) {
  std::vector<CellCount> cells = building();
  cells.push_back(cell(504, 502, 30, 5));
  cells.push_back(cell(501, 501, 32, 5));
  EXPECT_EQ(kept_points(cells), 320'010U);
}

TEST(AllCells, keeps_ghosts_too) {
  std::vector<CellCount> cells = building();
  cells.push_back(cell(600, 500, 30, 7));
  cells.push_back(cell(501, 501, 60, 3));
  std::uint64_t points = 0;
  for (const KeptTile& tile : all_cells(cells).tiles) {
    points += tile.points;
  }
  EXPECT_EQ(points, 320'010U);
  EXPECT_EQ(all_cells(cells).tiles.size(), 17U);
}

TEST(WithoutGhosts, keeps_a_second_building_but_no_far_cluster) {
  std::vector<CellCount> cells = building();
  cells.push_back(cell(560, 500, 30, 9'000));
  cells.push_back(cell(440, 500, 30, 1'500));
  EXPECT_EQ(kept_points(cells), 329'000U);
}

TEST(WithoutGhosts, follows_a_chain_of_filled_cells_but_not_of_sparse_ones) {
  std::vector<CellCount> filled = building();
  std::vector<CellCount> sparse = building();
  for (std::uint32_t i = 0; i < 20; ++i) {
    filled.push_back(cell(504 + 2 * i, 500, 30, 200));
    sparse.push_back(cell(504 + i, 500, 30, 12));
  }
  EXPECT_EQ(kept_points(filled), 324'000U);
  EXPECT_EQ(kept_points(sparse), 320'012U) << "only the first touches the building";
}

TEST(WithoutGhosts, keeps_a_small_far_building_as_dense_as_the_rest_wherever_cells_have_their_borders) {
  std::vector<CellCount> whole = building();
  std::vector<CellCount> divided = building();
  for (CellCount& dense : whole) dense.points *= 10;
  for (CellCount& dense : divided) dense.points *= 10;
  whole.push_back(cell(560, 500, 30, 60'000));
  for (std::uint32_t i = 0; i < 8; ++i) {
    divided.push_back(cell(560 + i % 2, 500 + i / 2 % 2, 30 + i / 4, 7'500));
  }
  std::vector<CellCount> thin = building();
  for (CellCount& dense : thin) dense.points *= 10;
  thin.push_back(cell(560, 500, 30, 30'000));
  EXPECT_EQ(kept_points(whole), 3'260'000U);
  EXPECT_EQ(kept_points(divided), 3'260'000U);
  EXPECT_EQ(kept_points(thin), 3'200'000U);
}

/// A corridor with one scanner at its end: points fall with the third power of the distance.
std::vector<CellCount> corridor(std::uint64_t first) {
  std::vector<CellCount> cells{cell(500, 500, 30, 100 * first)};
  for (std::uint32_t i = 1; i < 10; ++i) {
    cells.push_back(cell(500 + i, 500, 30, first / (i * i * i)));
  }
  return cells;
}

TEST(WithoutGhosts, keeps_the_thin_far_end_of_a_corridor) {
  std::uint64_t all = 0;
  for (const CellCount& count : corridor(50'000)) all += count.points;
  EXPECT_EQ(kept_points(corridor(50'000)), all);
}

TEST(WithoutGhosts, says_how_far_a_scan_goes_on_with_too_few_points) {
  const std::vector<CellCount> cells = corridor(90);
  const KeptCells kept = without_ghosts(cells);
  ASSERT_EQ(kept.tiles.size(), 3U);
  EXPECT_GE(kept.thin.points, 90U / 27 + 90U / 64);
  EXPECT_GE(kept.thin.cells, 2);
  EXPECT_LE(kept.thin.cells, 8);
  EXPECT_EQ(without_ghosts(building()).thin.points, 0U);
}

TEST(WithoutGhosts, sums_the_parts_of_cells_and_does_not_depend_on_their_order) {
  std::vector<CellCount> cells = building();
  for (const CellCount& part : building()) {
    cells.push_back(part);
  }
  std::vector<CellCount> reversed(cells.rbegin(), cells.rend());
  const std::vector<KeptTile> a = without_ghosts(cells).tiles;
  const std::vector<KeptTile> b = without_ghosts(reversed).tiles;
  ASSERT_EQ(a.size(), 16U);
  ASSERT_EQ(b.size(), 16U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].tile, b[i].tile);
    EXPECT_EQ(a[i].points, 40'000U);
    EXPECT_EQ(b[i].points, 40'000U);
    EXPECT_EQ(a[i].layers, std::uint64_t{3} << 30);
  }
  EXPECT_TRUE(std::is_sorted(a.begin(), a.end(), [](auto& p, auto& q) { return p.tile < q.tile; }));
}

TEST(WithoutGhosts, has_nothing_to_say_about_nothing) {
  EXPECT_TRUE(without_ghosts({}).tiles.empty());
}

}  // namespace
}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/cell_parts.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <map>

namespace roomcut::slice {
namespace {

struct Count {
  std::int64_t points = 0;
  Count& operator+=(const Count& other) {
    points += other.points;
    return *this;
  }
};

using Table = CellTable<Count>;

/// Part `part` of a tile: 300 cells, of which the next part has 150 again.
std::vector<Table::Entry> part_of(int tile, int part) {
  Table table;
  for (int i = 0; i < 300; ++i) {
    table.at({150 * part + i, tile, i % 3}) += {1 + i % 5};
  }
  return table.take();
}

TEST(CellParts, AddUpToTheSameInAnyOrderAndByAnyThreads) {
  constexpr int kTiles = 3, kParts = 200;
  std::map<std::tuple<int, int, int>, std::int64_t> expected;
  for (int tile = 0; tile < kTiles; ++tile) {
    for (int part = 0; part < kParts; ++part) {
      for (const auto& [key, sum] : part_of(tile, part)) {
        expected[{key.iy, key.ix, key.iz}] += sum.points;
      }
    }
  }
  CellParts<Count, decltype(by_column)> parts(by_column);
  tbb::parallel_for(0, kTiles * kParts, [&](int i) {
    const int tile = i % kTiles;
    parts.add(static_cast<std::size_t>(tile), part_of(tile, i / kTiles));
  });
  const auto entries = parts.take();
  ASSERT_EQ(entries.size(), expected.size());
  std::size_t at = 0;
  for (const auto& [key, points] : expected) {
    const auto& [cell, sum] = entries[at++];
    ASSERT_EQ(std::tuple(cell.iy, cell.ix, cell.iz), key);
    ASSERT_EQ(sum.points, points);
  }
  EXPECT_TRUE(parts.take().empty());
}

TEST(CellParts, HoldFewMoreEntriesThanThereAreCells) {
  CellParts<Count, decltype(by_column)> parts(by_column);
  for (int i = 0; i < 1000; ++i) {  // 300,000 entries of 300 cells
    parts.add(0, part_of(0, 0));
    ASSERT_LE(parts.held(), 10'000U);
  }
  const auto entries = parts.take();
  ASSERT_EQ(entries.size(), 300U);
  EXPECT_EQ(entries.front().sum.points % 1000, 0);
}

TEST(CellTable, IsEmptyAfterItsEntriesWereTaken) {
  Table table;
  table.at({1, 2, 3}) += {7};
  EXPECT_EQ(table.take().size(), 1U);
  EXPECT_EQ(table.at({1, 2, 3}).points, 0);
}

}  // namespace
}  // namespace roomcut::slice

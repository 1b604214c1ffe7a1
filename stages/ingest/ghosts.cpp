// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/ghosts.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "stages/ingest/fixed_grid.h"

namespace roomcut {

namespace {

constexpr double kFilledShare = 0.01;  // of a typical cell
constexpr double kGroupShare = 0.01;   // of the largest group
constexpr int kReach = 2;              // cells: at most one empty cell between two of a group

struct CellKey {
  int ix, iy, layer;
  auto operator<=>(const CellKey&) const = default;
};

struct CellState {
  std::uint64_t points = 0;
  int group = -1;
  bool filled = false;
};

using Cells = std::map<CellKey, CellState>;

CellKey key_of(const CellCount& cell) {
  return {static_cast<int>(cell.tile % fixed_grid::kWindowTiles),
          static_cast<int>(cell.tile / fixed_grid::kWindowTiles), static_cast<int>(cell.layer)};
}

template <class Visit>
void for_neighbours(Cells& cells, const CellKey& centre, int reach, Visit&& visit) {
  for (int dx = -reach; dx <= reach; ++dx) {
    for (int dy = -reach; dy <= reach; ++dy) {
      auto cell = cells.lower_bound({centre.ix + dx, centre.iy + dy, centre.layer - reach});
      while (cell != cells.end() && cell->first.ix == centre.ix + dx && cell->first.iy == centre.iy + dy &&
             cell->first.layer <= centre.layer + reach) {
        visit(cell->first, cell->second);
        ++cell;
      }
    }
  }
}

/// Points in the cell that holds the median point.
std::uint64_t typical_count(const Cells& cells) {
  std::vector<std::uint64_t> counts;
  std::uint64_t total = 0;
  for (const auto& [key, cell] : cells) {
    counts.push_back(cell.points);
    total += cell.points;
  }
  std::sort(counts.begin(), counts.end());
  std::uint64_t sum = 0;
  for (const std::uint64_t count : counts) {
    sum += count;
    if (2 * sum >= total) {
      return count;
    }
  }
  return 0;
}

/// Gives every well-filled cell the number of its group; returns the points of each group.
std::vector<std::uint64_t> group_cells(Cells& cells) {
  std::vector<std::uint64_t> points_of;
  for (auto& [start, first] : cells) {
    if (!first.filled || first.group >= 0) {
      continue;
    }
    const int group = static_cast<int>(points_of.size());
    points_of.push_back(0);
    first.group = group;
    std::vector<CellKey> open{start};
    while (!open.empty()) {
      const CellKey key = open.back();
      open.pop_back();
      points_of.back() += cells.at(key).points;
      for_neighbours(cells, key, kReach, [&](const CellKey& other, CellState& cell) {
        if (cell.filled && cell.group < 0) {
          cell.group = group;
          open.push_back(other);
        }
      });
    }
  }
  return points_of;
}

}  // namespace

std::vector<KeptTile> without_ghosts(std::vector<CellCount> counts) {
  Cells cells;
  for (const CellCount& count : counts) {
    cells[key_of(count)].points += count.points;
  }
  const double filled = kFilledShare * static_cast<double>(typical_count(cells));
  for (auto& [key, cell] : cells) {
    cell.filled = static_cast<double>(cell.points) >= filled;
  }
  const std::vector<std::uint64_t> points_of = group_cells(cells);
  const std::uint64_t largest = points_of.empty() ? 0 : *std::max_element(points_of.begin(), points_of.end());
  const auto is_kept = [&](const CellState& cell) {
    return cell.group >= 0 && static_cast<double>(points_of[static_cast<std::size_t>(cell.group)]) >=
                                  kGroupShare * static_cast<double>(largest);
  };
  std::map<std::uint32_t, KeptTile> tiles;
  for (const auto& [key, cell] : cells) {
    bool keep = is_kept(cell);
    if (!keep) {
      for_neighbours(cells, key, 1, [&](const CellKey&, CellState& other) { keep = keep || is_kept(other); });
    }
    if (keep) {
      const auto tile = static_cast<std::uint32_t>(key.iy * fixed_grid::kWindowTiles + key.ix);
      KeptTile& kept = tiles[tile];
      kept.tile = tile;
      kept.layers |= std::uint64_t{1} << key.layer;
      kept.points += cell.points;
    }
  }
  std::vector<KeptTile> result;
  for (const auto& [tile, kept] : tiles) {
    result.push_back(kept);
  }
  return result;
}

}  // namespace roomcut

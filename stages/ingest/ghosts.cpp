// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/ghosts.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <tuple>

#include "stages/ingest/fixed_grid.h"

namespace roomcut::ingest {

namespace {

constexpr double kFilledShare = 0.01;  // of a typical cell
constexpr double kDenseShare = 0.1;    // likewise: such cells are near a scanner
constexpr int kFarthest = 10;  // cells to the nearest dense one; farther ones are taken as near as that
constexpr std::uint64_t kFewestThin = 30;  // points of eight thin cells: fewer show no wall
constexpr double kGroupShare = 0.01;       // of the largest group
constexpr double kBuildingShare = 0.5;  // of a typical cell, in eight cells of a group: as dense as the rest
constexpr int kReach = 2;               // cells: at most one empty cell between two of a group

struct CellKey {
  int ix, iy, layer;
  bool operator<(const CellKey& other) const {
    return std::tie(ix, iy, layer) < std::tie(other.ix, other.iy, other.layer);
  }
};

struct CellState {
  std::uint64_t points = 0;
  int group = -1;
  bool filled = false;
  bool thin = false;  ///< would be filled for the distance, but has too few points to show anything
  bool kept = false;
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

/// Cells from `key` to the nearest one of at least `dense` points, at most kFarthest.
int distance_to_dense(Cells& cells, const CellKey& key, double dense) {
  for (int distance = 1; distance < kFarthest; ++distance) {
    bool found = false;
    for_neighbours(cells, key, distance, [&](const CellKey&, const CellState& cell) {
      found = found || static_cast<double>(cell.points) >= dense;
    });
    if (found) {
      return distance;
    }
  }
  return kFarthest;
}

/// The most points in two by two by two cells, of which `key` is one, counting those that `counts` accepts:
/// what is small falls into so many, wherever the borders of cells lie.
template <class Counts>
std::uint64_t densest_window(const Cells& cells, const CellKey& key, Counts&& counts) {
  std::uint64_t most = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const CellKey low{key.ix - corner % 2, key.iy - corner / 2 % 2, key.layer - corner / 4};
    std::uint64_t points = 0;
    for (int i = 0; i < 8; ++i) {
      const auto other = cells.find({low.ix + i % 2, low.iy + i / 2 % 2, low.layer + i / 4});
      points += other != cells.end() && counts(other->second) ? other->second.points : 0;
    }
    most = std::max(most, points);
  }
  return most;
}

/// Marks the well-filled cells. Along a floor or a wall the beams of one scanner get rarer with the third
/// power of the distance, so that the far end of a corridor is thin without being a ghost.
void mark_filled(Cells& cells, double typical) {
  for (auto& [key, cell] : cells) {
    const auto points = static_cast<double>(cell.points);
    cell.filled = points >= kFilledShare * typical;
    if (!cell.filled) {
      const double distance = distance_to_dense(cells, key, kDenseShare * typical);
      cell.thin = points >= kFilledShare * typical / (2 * distance * distance * distance);
    }
  }
  for (auto& [key, cell] : cells) {
    cell.filled = cell.filled || (cell.thin && densest_window(cells, key, [](const CellState& other) {
                                                 return other.thin;
                                               }) >= kFewestThin);
  }
}

/// The most points in two by two by two cells of each group.
std::vector<std::uint64_t> densest_windows(const Cells& cells, std::size_t groups) {
  std::vector<std::uint64_t> densest(groups, 0);
  for (const auto& [key, cell] : cells) {
    if (cell.group < 0) {
      continue;
    }
    const int group = cell.group;
    const std::uint64_t points =
        densest_window(cells, key, [group](const CellState& other) { return other.group == group; });
    std::uint64_t& most = densest[static_cast<std::size_t>(group)];
    most = std::max(most, points);
  }
  return densest;
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

/// Thin cells that hang together with the kept ones: where the scan goes on, but no model can.
ThinEnd thin_end(Cells& cells) {
  struct Reached {
    CellKey kept, cell;
  };
  std::vector<Reached> open;
  for (const auto& [key, cell] : cells) {
    if (cell.kept) {
      open.push_back({key, key});
    }
  }
  ThinEnd thin;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Reached from = open[i];
    for_neighbours(cells, from.cell, kReach, [&](const CellKey& other, CellState& cell) {
      if (cell.thin && !cell.kept) {
        cell.thin = false;
        thin.points += cell.points;
        thin.cells =
            std::max({thin.cells, std::abs(other.ix - from.kept.ix), std::abs(other.iy - from.kept.iy)});
        open.push_back({from.kept, other});
      }
    });
  }
  return thin;
}

std::vector<KeptTile> kept_tiles(const Cells& cells) {
  std::map<std::uint32_t, KeptTile> tiles;
  for (const auto& [key, cell] : cells) {
    if (cell.kept) {
      const auto tile = static_cast<std::uint32_t>(key.iy * fixed_grid::kWindowTiles + key.ix);
      KeptTile& kept = tiles[tile];
      kept.tile = tile;
      kept.layers |= std::uint64_t{1} << key.layer;
      kept.points += cell.points;
    }
  }
  std::vector<KeptTile> all;
  for (const auto& [tile, kept] : tiles) {
    all.push_back(kept);
  }
  return all;
}

}  // namespace

KeptCells without_ghosts(const std::vector<CellCount>& counts) {
  Cells cells;
  for (const CellCount& count : counts) {
    cells[key_of(count)].points += count.points;
  }
  const auto typical = static_cast<double>(typical_count(cells));
  mark_filled(cells, typical);
  const std::vector<std::uint64_t> points_of = group_cells(cells);
  const std::vector<std::uint64_t> densest = densest_windows(cells, points_of.size());
  const std::uint64_t largest = points_of.empty() ? 0 : *std::max_element(points_of.begin(), points_of.end());
  const auto is_kept = [&](const CellState& cell) {
    const auto group = static_cast<std::size_t>(cell.group);
    return cell.group >= 0 &&
           (static_cast<double>(points_of[group]) >= kGroupShare * static_cast<double>(largest) ||
            static_cast<double>(densest[group]) >= kBuildingShare * typical);
  };
  for (auto& [key, cell] : cells) {
    cell.kept = is_kept(cell);
    if (!cell.kept) {
      for_neighbours(cells, key, 1, [&kept = cell.kept, &is_kept](const CellKey&, CellState& other) {
        kept = kept || is_kept(other);
      });
    }
  }
  return {kept_tiles(cells), thin_end(cells)};
}

KeptCells all_cells(const std::vector<CellCount>& counts) {
  Cells cells;
  for (const CellCount& count : counts) {
    CellState& cell = cells[key_of(count)];
    cell.points += count.points;
    cell.kept = true;
  }
  return {kept_tiles(cells), {}};
}

}  // namespace roomcut::ingest

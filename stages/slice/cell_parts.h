// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "stages/slice/cell_table.h"

namespace roomcut::slice {

/// Adds up the entries of equal cells, which must be neighbours.
template <class Sum>
void add_up(std::vector<CellEntry<Sum>>& sorted) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (kept > 0 && sorted[kept - 1].key == sorted[i].key) {
      sorted[kept - 1].sum += sorted[i].sum;
    } else {
      sorted[kept++] = sorted[i];
    }
  }
  sorted.resize(kept);
}

/// The entries of all tiles, which come in parts. Dense scans have a part for every row of cells, and each
/// cell in two or three of them: those of a tile are added up before they are many, so that memory follows
/// the cells, not the points. Order-free.
template <class Sum, class Less>
class CellParts {
 public:
  using Entries = std::vector<CellEntry<Sum>>;
  explicit CellParts(Less less) : less_(less) {}

  /// Takes over a part of a tile. Thread-safe.
  void add(std::size_t tile, Entries&& part) {
    const std::scoped_lock lock(mutex_);
    Tile& own = tiles_[tile];
    own.held += part.size();
    own.parts.push_back(std::move(part));
    if (own.parts.size() > kFewParts && 2 * own.held > 3 * own.added_up + kFew) {
      add_up_tile(own);
    }
  }

  /// Entries held now.
  std::size_t held() const {
    std::size_t total = 0;
    for (const auto& [number, tile] : tiles_) total += tile.held;
    return total;
  }

  /// All cells, sorted; those that straddle tiles added up. Empties this.
  Entries take() {
    // First each tile of many parts: the list of all need not hold its cells twice.
    for (auto& [number, tile] : tiles_) {
      if (tile.added_up > 0) add_up_tile(tile);
    }
    Entries all;
    all.reserve(held());
    for (auto& [number, tile] : tiles_) append(tile, all);
    tiles_.clear();
    tbb::parallel_sort(all.begin(), all.end(), before());
    add_up(all);
    return all;
  }

 private:
  static constexpr std::size_t kFew = 8192;    ///< entries
  static constexpr std::size_t kFewParts = 8;  ///< as a scan of usual density has at most
  struct Tile {
    std::vector<Entries> parts;
    std::size_t held = 0;
    std::size_t added_up = 0;  ///< how many there were when they were added up last
  };
  /// Moves a tile's parts to the end of `all`.
  static void append(Tile& tile, Entries& all) {
    for (Entries& part : tile.parts) {
      all.insert(all.end(), part.begin(), part.end());
      Entries().swap(part);
    }
    tile.parts.clear();
  }
  static Entries join(Tile& tile) {
    Entries joined;
    joined.reserve(tile.held);
    append(tile, joined);
    return joined;
  }
  /// Not in parallel: a thread that waits may take up the next part, and wait for the lock that it holds.
  void add_up_tile(Tile& tile) const {
    Entries joined = join(tile);
    std::sort(joined.begin(), joined.end(), before());
    add_up(joined);
    tile.held = tile.added_up = joined.size();
    tile.parts.emplace_back(joined.begin(), joined.end());  // a copy without room for more
  }
  auto before() const {
    return [less = less_](const CellEntry<Sum>& a, const CellEntry<Sum>& b) { return less(a.key, b.key); };
  }

  Less less_;
  std::mutex mutex_;
  std::map<std::size_t, Tile> tiles_;
};

}  // namespace roomcut::slice

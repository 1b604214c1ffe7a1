// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "common/random/counter_random.h"

namespace roomcut::slice {

/// Cell of a sparse 3D raster: plan indices and a third one, a height bin or a wall slice.
struct CellKey {
  std::int32_t ix, iy, iz;
  friend bool operator==(const CellKey&, const CellKey&) = default;
};

/// Orders cells column by column: (iy, ix, iz).
inline constexpr auto by_column = [](const CellKey& a, const CellKey& b) {
  return std::tie(a.iy, a.ix, a.iz) < std::tie(b.iy, b.ix, b.iz);
};

/// Orders cells slice by slice: (iz, iy, ix).
inline constexpr auto by_slice = [](const CellKey& a, const CellKey& b) {
  return std::tie(a.iz, a.iy, a.ix) < std::tie(b.iz, b.iy, b.ix);
};

/// Sums per cell of a sparse raster: open addressing over a dense list of entries. Neighbouring points mostly
/// share a cell, so the last cell is tried first. Sum needs an operator+= whose result does not depend on the
/// order (integers).
template <class Sum>
struct CellEntry {
  CellKey key;
  Sum sum;
};

template <class Sum>
class CellTable {
 public:
  using Entry = CellEntry<Sum>;

  /// The sum of cell `key`, zero at first. The reference is valid until the next call.
  Sum& at(const CellKey& key) {
    if (last_ < entries_.size() && entries_[last_].key == key) return entries_[last_].sum;
    if ((entries_.size() + 1) * 2 > slots_.size()) grow();
    std::size_t slot = hash(key) & (slots_.size() - 1);
    while (slots_[slot] != 0 && !(entries_[slots_[slot] - 1].key == key))
      slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] == 0) {
      entries_.push_back({key, Sum{}});
      slots_[slot] = static_cast<std::uint32_t>(entries_.size());
    }
    last_ = slots_[slot] - 1;
    return entries_[last_].sum;
  }

  /// Hands over the entries, in the order of their first use and without room for more, and empties the
  /// table.
  std::vector<Entry> take() {
    std::vector<Entry> taken(entries_.begin(), entries_.end());
    entries_.clear();
    slots_.assign(slots_.size(), 0);
    last_ = 0;
    return taken;
  }

 private:
  static std::size_t hash(const CellKey& key) {
    const auto low = static_cast<std::uint32_t>(key.ix) |
                     (static_cast<std::uint64_t>(static_cast<std::uint32_t>(key.iy)) << 32U);
    return mix64(low ^
                 (static_cast<std::uint64_t>(static_cast<std::uint32_t>(key.iz)) * 0x9e3779b97f4a7c15ULL));
  }

  void grow() {
    slots_.assign(slots_.empty() ? 1024 : slots_.size() * 2, 0);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      std::size_t slot = hash(entries_[i].key) & (slots_.size() - 1);
      while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = static_cast<std::uint32_t>(i + 1);
    }
  }

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> slots_;  ///< entry index + 1; 0 = free; size is a power of two
  std::size_t last_ = 0;
};

}  // namespace roomcut::slice

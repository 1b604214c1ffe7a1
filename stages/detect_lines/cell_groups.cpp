// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/cell_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace roomcut::detect_lines {
namespace {

struct Place {
  std::int32_t slice, row, column;
  std::size_t index;  ///< into `some`
  bool operator<(const Place& other) const {
    return std::tie(slice, row, column) < std::tie(other.slice, other.row, other.column);
  }
};

/// Sets that are joined step by step; the smallest member stands for its set.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    const auto [low, high] = std::minmax({find(i), find(j)});
    parent_[high] = low;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<CellIndices> group_cells(const WallCells& cells, const CellIndices& some, double tau_m,
                                     std::int32_t reach) {
  std::vector<Place> places;
  places.reserve(some.size());
  const auto cell_of = [&](float metres) {
    return static_cast<std::int32_t>(std::floor(static_cast<double>(metres) / tau_m));
  };
  for (std::size_t k = 0; k < some.size(); ++k) {
    const std::uint32_t i = some[k];
    places.push_back({cells.slice[i], cell_of(cells.y[i]), cell_of(cells.x[i]), k});
  }
  std::sort(places.begin(), places.end());
  JoinedSets sets(some.size());
  for (auto place = places.begin(); place != places.end(); ++place) {
    for (std::int32_t row = place->row; row <= place->row + reach; ++row) {
      const std::int32_t first = row == place->row ? place->column + 1 : place->column - reach;
      auto near = std::lower_bound(place, places.end(), Place{place->slice, row, first, 0});
      for (; near != places.end() && near->slice == place->slice && near->row == row &&
             near->column <= place->column + reach;
           ++near) {
        sets.join(place->index, near->index);
      }
    }
  }
  std::vector<CellIndices> groups;
  std::map<std::size_t, std::size_t> group_of;
  for (std::size_t k = 0; k < some.size(); ++k) {
    const auto [found, fresh] = group_of.try_emplace(sets.find(k), groups.size());
    if (fresh) groups.emplace_back();
    groups[found->second].push_back(some[k]);
  }
  return groups;
}

}  // namespace roomcut::detect_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace roomcut {
namespace {

constexpr double kBlock = 1.0;  // m; edge of the blocks in which drift is measured

/// Disjoint sets with the smallest member as root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Joins every cell with those cells of the columns (ix-1, iy) and (ix, iy-1) for which `connected` holds.
template <class Connected>
DisjointSets connect(const std::vector<SurfaceCell>& cells, Connected connected) {
  DisjointSets sets(cells.size());
  std::size_t below = 0;  // first cell of the column under the current one, moving along with it
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const SurfaceCell& cell = cells[i];
    for (std::size_t j = i; j-- > 0 && cells[j].iy == cell.iy && cells[j].ix >= cell.ix - 1;) {
      if (cells[j].ix == cell.ix - 1 && connected(cells[j], cell)) sets.join(i, j);
    }
    while (std::tie(cells[below].iy, cells[below].ix) < std::make_tuple(cell.iy - 1, cell.ix)) ++below;
    for (std::size_t j = below; cells[j].iy == cell.iy - 1 && cells[j].ix == cell.ix; ++j) {
      if (connected(cells[j], cell)) sets.join(i, j);
    }
  }
  return sets;
}

struct Block {
  double area = 0, moment = 0;
  double z() const { return moment / area; }
};

/// 0 for no values.
double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Drift of one surface from its mean heights in blocks of 1 m. Level surfaces meet their neighbour blocks at
/// the same height; the median over neighbours keeps a single step or a few disturbed blocks from counting as
/// drift.
double drift_of(const std::vector<SurfaceCell>& cells, const std::vector<std::size_t>& members,
                double raster_m, double noise_m) {
  std::map<std::pair<std::int32_t, std::int32_t>, Block> blocks;
  const double per_block = raster_m / kBlock;
  for (const std::size_t i : members) {
    Block& block = blocks[{static_cast<std::int32_t>(std::floor((cells[i].iy + 0.5) * per_block)),
                           static_cast<std::int32_t>(std::floor((cells[i].ix + 0.5) * per_block))}];
    block.area += cells[i].area_m2;
    block.moment += cells[i].area_m2 * cells[i].z;
  }
  std::erase_if(blocks, [](const auto& entry) { return entry.second.area < 0.2 * kBlock * kBlock; });
  std::array<std::vector<double>, 2> steps;  // along x and along y: a floor may tilt one way only
  double area = 0, first = 0, second = 0;
  for (const auto& [place, block] : blocks) {
    area += block.area;
    first += block.area * block.z();
    second += block.area * block.z() * block.z();
    const std::array next = {std::make_pair(place.first, place.second + 1),
                             std::make_pair(place.first + 1, place.second)};
    for (std::size_t k = 0; k < next.size(); ++k) {
      const auto found = blocks.find(next[k]);
      if (found != blocks.end()) steps[k].push_back(std::abs(found->second.z() - block.z()));
    }
  }
  // A block holds tens to hundreds of points: their mean is good to a tenth of the noise or better.
  if (std::max(median(steps[0]), median(steps[1])) < std::max(0.001, 0.2 * noise_m)) return 0;
  const double mean = first / area;
  return std::sqrt(std::max(0.0, second / area - mean * mean));
}

}  // namespace

std::vector<SurfaceCell> surface_cells(const std::vector<SurfacePatch>& patches, double noise_m) {
  const double apart = std::max(0.025, 3 * noise_m);
  std::vector<SurfaceCell> cells;
  double last_z = 0, second = 0;
  const auto close = [&] {
    SurfaceCell& cell = cells.back();
    cell.rms_m = std::sqrt(std::max(0.0, second / cell.area_m2 - cell.z * cell.z));
  };
  for (const SurfacePatch& patch : patches) {
    const bool same = !cells.empty() && cells.back().ix == patch.ix && cells.back().iy == patch.iy &&
                      patch.z - last_z < apart;
    if (!same) {
      if (!cells.empty()) close();
      cells.push_back({patch.ix, patch.iy, 0, 0, 0, 0, 0});
      second = 0;
    }
    SurfaceCell& cell = cells.back();
    const double area = cell.area_m2 + patch.area_m2;
    cell.z += (patch.z - cell.z) * patch.area_m2 / area;
    cell.area_m2 = area;
    cell.count += patch.count;
    second += patch.area_m2 * patch.z * patch.z;
    last_z = patch.z;
  }
  if (!cells.empty()) close();
  return cells;
}

void measure_drift(std::vector<SurfaceCell>& cells, double raster_m, double noise_m) {
  // A cell across a step mixes two surfaces: its points spread more than noise does, and it connects nothing.
  const double mixed = std::max(0.006, 1.8 * noise_m);
  DisjointSets sets = connect(cells, [&](const SurfaceCell& a, const SurfaceCell& b) {
    if (a.rms_m > mixed || b.rms_m > mixed) return false;
    const double step = 3 * noise_m * std::sqrt(1.0 / a.count + 1.0 / b.count);
    return std::abs(a.z - b.z) <= std::max(0.004, step);
  });
  std::vector<std::pair<std::size_t, std::size_t>> members(cells.size());  // (surface, cell)
  for (std::size_t i = 0; i < cells.size(); ++i) members[i] = {sets.root(i), i};
  std::sort(members.begin(), members.end());
  for (std::size_t first = 0; first < members.size();) {
    std::size_t end = first;
    std::vector<std::size_t> surface;
    for (; end < members.size() && members[end].first == members[first].first; ++end)
      surface.push_back(members[end].second);
    const double drift = drift_of(cells, surface, raster_m, noise_m);
    for (const std::size_t i : surface) cells[i].drift_m = drift;
    first = end;
  }
}

double largest_component_m2(const std::vector<SurfaceCell>& cells, double lo, double hi, double raster_m) {
  std::vector<SurfaceCell> inside;
  for (const SurfaceCell& cell : cells) {
    const bool new_column = inside.empty() || inside.back().ix != cell.ix || inside.back().iy != cell.iy;
    if (new_column && lo <= cell.z && cell.z <= hi) inside.push_back(cell);
  }
  DisjointSets sets = connect(inside, [](const SurfaceCell&, const SurfaceCell&) { return true; });
  std::vector<std::size_t> size(inside.size(), 0);
  std::size_t largest = 0;
  for (std::size_t i = 0; i < inside.size(); ++i) largest = std::max(largest, ++size[sets.root(i)]);
  return static_cast<double>(largest) * raster_m * raster_m;
}

}  // namespace roomcut

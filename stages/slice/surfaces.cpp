// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "stages/slice/fixed_point.h"
#include "stages/slice/surface_graph.h"

namespace roomcut::slice {
namespace {

constexpr double kBlock = 1.0;           // m; edge of the blocks in which drift is measured
constexpr double kSteepestDrift = 0.04;  // steeper is built that way: a ramp, a vault

using Members = std::vector<std::size_t>;

/// Cells of each set, in the order of the sets' first cells.
std::vector<Members> sets_of(DisjointSets& sets, std::size_t cells) {
  std::vector<Members> groups;
  std::vector<std::size_t> group(cells);  // of a root; it is the first cell of its set
  for (std::size_t i = 0; i < cells; ++i) {
    const std::size_t root = sets.root(i);
    if (root == i) {
      group[i] = groups.size();
      groups.emplace_back();
    }
    groups[group[root]].push_back(i);
  }
  return groups;
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
  using Place = std::pair<std::int32_t, std::int32_t>;
  std::map<Place, Block> blocks;
  const double per_block = raster_m / kBlock;
  auto last = blocks.end();  // neighbours in a row mostly share a block
  for (const std::size_t i : members) {
    const Place place{floor_to_int((cells[i].iy + 0.5) * per_block),
                      floor_to_int((cells[i].ix + 0.5) * per_block)};
    if (last == blocks.end() || last->first != place) {
      last = blocks.try_emplace(place).first;
    }
    last->second.area += cells[i].area_m2;
    last->second.moment += cells[i].area_m2 * cells[i].z;
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
  const double slope = std::max(median(steps[0]), median(steps[1])) / kBlock;
  if (slope < std::max(0.001, 0.2 * noise_m / kBlock) || slope > kSteepestDrift) return 0;
  const double mean = first / area;
  return std::sqrt(std::max(0.0, second / area - mean * mean));
}

/// Scraps that noise has cut off lie on a larger surface: they take the largest drift of the cells around
/// them that is large enough to explain their distance from it.
void lend_drift(std::vector<SurfaceCell>& cells, const Members& scraps, double raster_m) {
  const CellIndex index(cells);
  const auto radius = static_cast<std::int32_t>(std::ceil(0.3 / raster_m));
  std::vector<double> lent(scraps.size(), 0);
  for (std::size_t k = 0; k < scraps.size(); ++k) {
    const SurfaceCell& scrap = cells[scraps[k]];
    for (std::int32_t dy = -radius; dy <= radius; ++dy) {
      const auto [from, to] = index.find(scrap.iy + dy, scrap.ix - radius, scrap.ix + radius);
      for (std::size_t j = from; j < to; ++j) {
        if (std::abs(cells[j].z - scrap.z) <= 2 * cells[j].drift_m)
          lent[k] = std::max(lent[k], cells[j].drift_m);
      }
    }
  }
  for (std::size_t k = 0; k < scraps.size(); ++k) cells[scraps[k]].drift_m = lent[k];
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
  constexpr double kSame_m = 0.004;
  DisjointSets sets = connect_cells(cells, raster_m, [&](const SurfaceCell& a, const SurfaceCell& b) {
    if (a.rms_m > mixed || b.rms_m > mixed) return false;
    const double apart = std::abs(a.z - b.z);
    if (apart <= kSame_m) return true;  // nearly all pairs end here or in the next line: the last one is slow
    if (apart > 3 * std::numbers::sqrt2 * noise_m) return false;
    return apart <= 3 * noise_m * std::sqrt(1.0 / a.count + 1.0 / b.count);
  });
  Members scraps;
  for (const Members& members : sets_of(sets, cells.size())) {
    double area = 0;
    for (const std::size_t i : members) area += cells[i].area_m2;
    if (area < kBlock * kBlock) {
      scraps.insert(scraps.end(), members.begin(), members.end());
    } else {
      const double drift = drift_of(cells, members, raster_m, noise_m);
      for (const std::size_t i : members) cells[i].drift_m = drift;
    }
  }
  lend_drift(cells, scraps, raster_m);
}

std::vector<SurfaceComponent> components(const std::vector<SurfaceCell>& cells, double lo, double hi,
                                         double raster_m) {
  std::vector<SurfaceCell> inside;
  for (const SurfaceCell& cell : cells) {
    if (cell.z < lo || cell.z > hi) continue;
    if (inside.empty() || inside.back().ix != cell.ix || inside.back().iy != cell.iy) {
      inside.push_back(cell);
    } else {
      inside.back().area_m2 += cell.area_m2;
      inside.back().count += cell.count;
    }
  }
  DisjointSets sets =
      connect_cells(inside, raster_m, [](const SurfaceCell&, const SurfaceCell&) { return true; });
  std::vector<SurfaceComponent> found;
  for (const Members& members : sets_of(sets, inside.size())) {
    SurfaceComponent component;
    for (const std::size_t i : members) {
      component.area_m2 += inside[i].area_m2;
      component.cells.push_back(inside[i]);
    }
    found.push_back(std::move(component));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.area_m2 > b.area_m2; });
  return found;
}

}  // namespace roomcut::slice

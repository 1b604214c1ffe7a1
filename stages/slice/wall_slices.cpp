// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/wall_slices.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "stages/slice/cell_parts.h"
#include "stages/slice/fixed_point.h"

namespace roomcut::slice {
namespace {

constexpr double kBinHeight = 0.12;           // m
constexpr int kMaxBins = 64;                  // one bit each
constexpr double kLengthUnit = 0x1.0p-20;     // m; centroids are good to a micrometre
constexpr double kAreaUnit = 0x1.0p-30;       // m^2
constexpr double kDirectionUnit = 0x1.0p-14;  // of a unit vector
constexpr double kFullWeightHeight = 0.25;    // m; lower slices (slabs) speak for less

struct EvidenceSum {
  std::int64_t count = 0, walls = 0;
  std::int64_t x = 0, y = 0;  // offsets from the cell's corner
  std::int64_t area = 0;
  std::int64_t cos2 = 0, sin2 = 0;  // of twice the azimuth, which is periodic in pi
  std::uint64_t bins = 0;
  std::uint64_t slope = 0;  // 1 = on a contour: the step goes through the whole slice
  EvidenceSum& operator+=(const EvidenceSum& other) {
    count += other.count;
    walls += other.walls;
    x += other.x;
    y += other.y;
    area += other.area;
    cos2 += other.cos2;
    sin2 += other.sin2;
    bins |= other.bins;
    slope |= other.slope;
    return *this;
  }
};

struct Direction {
  std::int64_t cos2, sin2;
};

std::array<Direction, kAzimuthSteps> direction_table() {
  std::array<Direction, kAzimuthSteps> table{};
  for (int k = 0; k < kAzimuthSteps; ++k) {
    const double twice = 2 * azimuth_of(static_cast<std::uint8_t>(k));
    table[static_cast<std::size_t>(k)] = {std::llround(std::cos(twice) / kDirectionUnit),
                                          std::llround(std::sin(twice) / kDirectionUnit)};
  }
  return table;
}

/// Index of the evidence range that holds height z, or -1. Ranges are ascending and disjoint.
int range_of(const std::vector<EvidenceRange>& ranges, float z) {
  const auto above =
      std::upper_bound(ranges.begin(), ranges.end(), z,
                       [](float height, const EvidenceRange& range) { return height < range.lo; });
  if (above == ranges.begin()) return -1;
  const auto found = above - 1;
  return found->bins > 0 && z < found->hi ? static_cast<int>(found - ranges.begin()) : -1;
}

void add_tile(const CloudTile& tile, const std::vector<EvidenceRange>& ranges, double tau_m,
              bool upright_only, CellTable<EvidenceSum>& table) {
  static const std::array<Direction, kAzimuthSteps> kDirections = direction_table();
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const auto surface = static_cast<SurfaceClass>(tile.surface[i]);
    if (upright_only && surface == SurfaceClass::kHorizontal) continue;
    const int slice = range_of(ranges, tile.z[i]);
    if (slice < 0) continue;
    const EvidenceRange& range = ranges[static_cast<std::size_t>(slice)];
    const bool slope = upright_only && surface == SurfaceClass::kSloped;
    if (slope && !(std::abs(tile.z[i] - range.contour_z) < range.contour_half_m)) continue;
    const std::int32_t column = floor_to_int(tile.x[i] / tau_m);
    const std::int32_t row = floor_to_int(tile.y[i] / tau_m);
    EvidenceSum& sum = table.at({column, row, slice});
    ++sum.count;
    sum.x += to_units(std::max(0.0, tile.x[i] - column * tau_m), kLengthUnit);
    sum.y += to_units(std::max(0.0, tile.y[i] - row * tau_m), kLengthUnit);
    sum.area += to_units(tile.area[i], kAreaUnit);
    const int bin = std::min(static_cast<int>((tile.z[i] - range.lo) / range.bin_m()), range.bins - 1);
    sum.bins |= std::uint64_t{1} << static_cast<unsigned>(bin);
    if (slope) sum.slope = 1;
    if (surface == SurfaceClass::kWall) {
      ++sum.walls;
      sum.cos2 += kDirections[tile.azimuth[i]].cos2;
      sum.sin2 += kDirections[tile.azimuth[i]].sin2;
    }
  }
}

/// Share of the range's height that is occupied, over what a closed wall of this density would show.
double coverage_of(const EvidenceSum& sum, const EvidenceRange& range, double tau_m) {
  if (sum.slope != 0) return 1;
  const double seen = static_cast<double>(std::popcount(sum.bins)) / range.bins;
  const double density = static_cast<double>(sum.count) / (static_cast<double>(sum.area) * kAreaUnit);
  const double expected = 1 - std::exp(-density * tau_m * range.bin_m());
  return std::min(1.0, seen / std::max(expected, 0.04));
}

/// Length of wall in the cell times the share of the range's height that was seen: the area for which the
/// points stand. It sums up to the same however the grid lies to a wall, one cell wide along it or two, or
/// across it.
double covered_length(const EvidenceSum& sum, const EvidenceRange& range, double tau_m) {
  if (sum.slope != 0) return tau_m;
  const double height = range.hi - range.lo;
  return height > 0 ? std::min(2 * tau_m, static_cast<double>(sum.area) * kAreaUnit / height) : 0;
}

void append_cell(const CellEntry<EvidenceSum>& entry, const EvidenceRange& range, double tau_m,
                 OccupancyGrid& grid) {
  const EvidenceSum& sum = entry.sum;
  const double n = static_cast<double>(sum.count);
  grid.ix.push_back(entry.key.ix);
  grid.iy.push_back(entry.key.iy);
  grid.x.push_back(static_cast<float>(entry.key.ix * tau_m + static_cast<double>(sum.x) * kLengthUnit / n));
  grid.y.push_back(static_cast<float>(entry.key.iy * tau_m + static_cast<double>(sum.y) * kLengthUnit / n));
  grid.coverage.push_back(static_cast<float>(coverage_of(sum, range, tau_m)));
  grid.weight_m.push_back(static_cast<float>(covered_length(sum, range, tau_m) *
                                             std::min(1.0, range.slice_m / kFullWeightHeight)));
  grid.area_m2.push_back(static_cast<float>(static_cast<double>(sum.area) * kAreaUnit));
  const double cos2 = static_cast<double>(sum.cos2) * kDirectionUnit;
  const double sin2 = static_cast<double>(sum.sin2) * kDirectionUnit;
  const double azimuth = normalised(0.5 * std::atan2(sin2, cos2), 0).theta;
  const int step = static_cast<int>(azimuth / std::numbers::pi * kAzimuthSteps);
  grid.azimuth.push_back(static_cast<std::uint8_t>(std::min(step, kAzimuthSteps - 1)));
  const double trust = std::min(1.0, std::hypot(cos2, sin2) / n);
  grid.azimuth_trust.push_back(static_cast<std::uint8_t>(std::lround(255 * trust)));
}

/// Height of the contour where stairs rise from level k to the next one, when one of them stands for a slope:
/// half way from step to step. NaN when there is none.
double contour_between(const std::vector<Level>& levels, std::size_t k) {
  const Level& lower = levels[k];
  const Level& upper = levels[k + 1];
  if (lower.step && !upper.cap) return 0.5 * (lower.z + upper.z);
  if (upper.step && k + 2 < levels.size()) {  // the foot of the slope
    const double z = upper.z - 0.5 * (levels[k + 2].z - upper.z);
    if (z > lower.hi) return z;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<EvidenceRange> evidence_ranges(const std::vector<Level>& levels, double tall_slice_m,
                                           double evidence_share, const std::vector<SlopedPlane>& planes,
                                           double contour_half_m) {
  const auto passed = [&planes](double z) {
    return std::any_of(planes.begin(), planes.end(), [z](const SlopedPlane& plane) {
      const auto [low, high] = plane.range();
      return low <= z && z <= high;
    });
  };
  std::vector<EvidenceRange> ranges;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    EvidenceRange range{levels[k].hi, levels[k + 1].lo, std::max(0.0, levels[k + 1].lo - levels[k].hi)};
    const bool seen_ceiling = !levels[k + 1].cap;
    if (range.slice_m > tall_slice_m && seen_ceiling) range.lo = range.hi - evidence_share * range.slice_m;
    if (range.slice_m > 0) {
      range.bins = std::clamp(static_cast<int>(std::lround((range.hi - range.lo) / kBinHeight)), 1, kMaxBins);
    }
    range.contour_z = contour_between(levels, k);
    if (passed(range.contour_z)) range.contour_z = std::numeric_limits<double>::quiet_NaN();
    range.contour_half_m = contour_half_m;
    ranges.push_back(range);
  }
  return ranges;
}

std::vector<OccupancyGrid> occupy_wall_slices(const TileSource& tiles,
                                              const std::vector<EvidenceRange>& ranges, double tau_m,
                                              bool upright_only) {
  tbb::enumerable_thread_specific<CellTable<EvidenceSum>> tables;
  CellParts<EvidenceSum, decltype(by_slice)> parts(by_slice);
  tiles([&](std::size_t index, const CloudTile& tile) {
    CellTable<EvidenceSum>& table = tables.local();
    add_tile(tile, ranges, tau_m, upright_only, table);
    parts.add(index, table.take());
  });
  std::vector<OccupancyGrid> grids(ranges.size());
  for (const auto& entry : parts.take()) {
    const auto slice = static_cast<std::size_t>(entry.key.iz);
    append_cell(entry, ranges[slice], tau_m, grids[slice]);
  }
  return grids;
}

}  // namespace roomcut::slice

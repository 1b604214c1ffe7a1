// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/tile_grid.h"

#include <algorithm>

#include "stages/ingest/duplicates.h"

namespace roomcut::ingest {

using namespace fixed_grid;

namespace {

constexpr std::uint16_t kDropped = 0xffff;
constexpr int kColumns = TileColumns::kAlong;
constexpr std::uint64_t kAllLayers = ~std::uint64_t{0};

/// -1, 0, 1: below, inside or above the tile, for units from the halo's corner.
int side(std::int32_t units) {
  return (units >= kHaloUnits + kTileUnits ? 1 : 0) - (units < kHaloUnits ? 1 : 0);
}

/// Turns counts into begins, as a counting sort needs them.
void to_begins(std::vector<std::uint32_t>& counts) {
  std::uint32_t sum = 0;
  for (std::uint32_t& count : counts) {
    const std::uint32_t here = count;
    count = sum;
    sum += here;
  }
}

}  // namespace

void TileGrid::begin(const TilePlace& place, float lowest_z, const UnitScale& scale) {
  corner_ = {place.ix * kTileUnits - kHaloUnits, place.iy * kTileUnits - kHaloUnits,
             scale.units(lowest_z) & ~((1 << (kVoxelBits + kLevels - 1)) - 1)};
  levels_[0].clear(0);
  levels_[0].begin.reserve(std::size_t{kColumns} * kColumns + 1);
}

void TileGrid::find_keys(const TileRuns& runs, const TilePlace& place, const UnitScale& scale) {
  const bool all =
      std::all_of(place.layers.begin(), place.layers.end(), [](auto l) { return l == kAllLayers; });
  std::size_t total = 0;
  for (const TileRun& run : runs) {
    total += run.points;
  }
  column_.resize(total);
  height_.resize(total);
  columns_begin_.assign(std::size_t{kColumns} * kColumns + 1, 0);
  std::size_t i = 0;
  const auto find_key = [&](float x, float y, float z) {
    const std::int32_t rx = scale.units(x) - corner_[0];
    const std::int32_t ry = scale.units(y) - corner_[1];
    const std::int32_t uz = scale.units(z);
    column_[i] = static_cast<std::uint16_t>((ry >> kVoxelBits) * kColumns + (rx >> kVoxelBits));
    height_[i] = static_cast<std::uint16_t>((uz - corner_[2]) >> kVoxelBits);
    if (!all) {
      const int layer = (uz >> kTileBits) - place.window_z;
      const auto beside = static_cast<std::size_t>(side(ry) + 1) * 3 + static_cast<std::size_t>(side(rx) + 1);
      if ((place.layers[beside] >> layer & 1) == 0) {
        column_[i] = kDropped;
        return;
      }
    }
    ++columns_begin_[column_[i]];
  };
  for (const TileRun& run : runs) {
    for (std::size_t k = 0; k < run.points; ++k, ++i) {
      find_key(run.x[k], run.y[k], run.z[k]);
    }
  }
  to_begins(columns_begin_);
}

/// A counting sort by column, and then in each column, within the cache, by height: one copy of the tile.
/// Afterwards columns_begin_ holds the ends.
void TileGrid::sort_keyed(const TileRuns& runs, bool distinct) {
  sorted_.resize(columns_begin_.back());
  std::size_t i = 0;
  for (const TileRun& run : runs) {
    for (std::size_t k = 0; k < run.points; ++k, ++i) {
      if (column_[i] != kDropped) {
        sorted_[columns_begin_[column_[i]]++] = {
            run.x[k], run.y[k], run.z[k], run.hint != nullptr ? run.hint[k] : std::uint16_t{0}, height_[i]};
      }
    }
  }
  voxels_ = 0;
  std::size_t first = 0;
  std::size_t kept = 0;
  for (std::size_t column = 0; column + 1 < columns_begin_.size(); ++column) {
    const std::size_t last = columns_begin_[column];
    const std::size_t begin = kept;
    kept = distinct ? move_distinct(first, last, kept) : last;
    columns_begin_[column] = static_cast<std::uint32_t>(kept);
    sort_column(begin, kept);
    for (std::size_t k = begin; k < kept; ++k) {  // while the column is in the cache
      voxels_ += k == begin || sorted_[k].height != sorted_[k - 1].height ? 1 : 0;
    }
    first = last;
  }
  sorted_.resize(kept);
}

/// Moves the first points with their coordinates to `to`, in their order; returns the end there.
std::size_t TileGrid::move_distinct(std::size_t first, std::size_t last, std::size_t to) {
  keys_.clear();
  for (std::size_t i = first; i < last; ++i) {
    keys_.emplace_back(key_of_point(sorted_[i].x, sorted_[i].y, sorted_[i].z), i);
  }
  std::sort(keys_.begin(), keys_.end());
  firsts_.clear();
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    if (k == 0 || keys_[k].first != keys_[k - 1].first) {
      firsts_.push_back(keys_[k].second);
    }
  }
  std::sort(firsts_.begin(), firsts_.end());
  for (const std::size_t i : firsts_) {
    sorted_[to++] = sorted_[i];
  }
  return to;
}

std::uint64_t TileGrid::own_points() const {
  std::uint64_t points = 0;
  for (int k = columns_.begin; k < columns_.end; ++k) {
    const int ix = k % kColumns - kHaloVoxels;
    const int iy = k / kColumns - kHaloVoxels;
    const auto column = static_cast<std::size_t>(k);
    if (ix >= 0 && ix < kTileVoxels && iy >= 0 && iy < kTileVoxels) {
      points += columns_begin_[column] - (k == 0 ? 0 : columns_begin_[column - 1]);
    }
  }
  return points;
}

/// Stable.
void TileGrid::sort_column(std::size_t first, std::size_t last) {
  const auto begin = sorted_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = sorted_.begin() + static_cast<std::ptrdiff_t>(last);
  const auto lower = [](const Point& a, const Point& b) { return a.height < b.height; };
  if (std::is_sorted(begin, end, lower)) {
    return;  // a floor alone
  }
  const auto [lowest, highest] = std::minmax_element(begin, end, lower);
  const std::uint16_t base = lowest->height;
  heights_begin_.assign(static_cast<std::size_t>(highest->height - base) + 1, 0);
  column_points_.assign(begin, end);
  for (const Point& point : column_points_) {
    ++heights_begin_[static_cast<std::size_t>(point.height - base)];
  }
  to_begins(heights_begin_);
  for (const Point& point : column_points_) {
    sorted_[first + heights_begin_[static_cast<std::size_t>(point.height - base)]++] = point;
  }
}

void TileGrid::sum_moments(const UnitScale& scale) {
  VoxelLevel& level = levels_[0];
  const auto relative = [&](float metres, std::size_t axis) {
    return static_cast<std::uint32_t>(scale.units(metres) - corner_[axis]);
  };
  std::size_t i = 0;
  for (auto column = static_cast<std::size_t>(columns_.begin);
       column < static_cast<std::size_t>(columns_.end); ++column) {
    level.begin.push_back(static_cast<std::uint32_t>(level.size()));
    for (const std::size_t end = columns_begin_[column]; i < end;) {
      const std::uint16_t height = sorted_[i].height;
      Moments sum;
      for (; i < end && sorted_[i].height == height; ++i) {
        sum.add_point(relative(sorted_[i].x, 0), relative(sorted_[i].y, 1), relative(sorted_[i].z, 2));
      }
      level.z.push_back(height);
      level.moments.push_back(sum);
    }
  }
}

void TileGrid::sort_columns(const TileRuns& runs, const TileColumns& columns, const TilePlace& place,
                            const UnitScale& scale) {
  columns_ = columns;
  find_keys(runs, place, scale);
  sort_keyed(runs, place.distinct);
}

void TileGrid::finish() {
  levels_[0].begin.push_back(static_cast<std::uint32_t>(levels_[0].size()));
  for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
    coarsen(levels_[i], levels_[i + 1]);
  }
}

void TileGrid::build(const TileRuns& runs, const TilePlace& place, const UnitScale& scale) {
  begin(place, lowest_of(runs), scale);
  sort_columns(runs, {}, place, scale);
  levels_[0].reserve(voxels_);
  sum_moments(scale);
  finish();
}

std::array<std::uint32_t, 3> TileGrid::centre(int level, int ix, int iy, std::uint16_t z) const {
  const int bits = kVoxelBits + level;
  const auto middle = [bits](int voxel) {
    return (static_cast<std::uint32_t>(voxel) << bits) + (std::uint32_t{1} << (bits - 1));
  };
  return {middle(ix), middle(iy), middle(z)};
}

}  // namespace roomcut::ingest

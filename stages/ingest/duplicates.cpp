// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/duplicates.h"

#include <algorithm>
#include <bit>

namespace roomcut::ingest {

namespace {

constexpr std::uint32_t kSampled = 16;  // one voxel of so many

/// The coordinates mixed into one number; that two others give the same is not to be expected in any scan.
std::uint64_t key_of(const TileGrid::Point& point) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;
  std::uint64_t key =
      std::uint64_t{std::bit_cast<std::uint32_t>(point.x)} << 32U | std::bit_cast<std::uint32_t>(point.y);
  key *= kOdd;
  key ^= key >> 32U;
  key += std::bit_cast<std::uint32_t>(point.z);
  key *= kOdd;
  return key ^ key >> 29U;
}

}  // namespace

std::uint64_t DuplicateCounter::count_voxel(const TileGrid& grid, std::uint32_t first, std::uint32_t last) {
  if (last - first < 2) {
    return 0;
  }
  keys_.clear();
  for (std::uint32_t i = first; i < last; ++i) {
    keys_.push_back(key_of(grid.points()[i]));
  }
  std::sort(keys_.begin(), keys_.end());
  const auto distinct = std::unique(keys_.begin(), keys_.end()) - keys_.begin();
  return keys_.size() - static_cast<std::uint64_t>(distinct);
}

std::uint64_t DuplicateCounter::count(const TileGrid& grid) {
  std::uint64_t sampled = 0;
  std::uint32_t number = 0;
  for_own_voxels(grid, [&](std::uint32_t /*voxel*/, std::uint32_t first, std::uint32_t last) {
    if (number++ % kSampled == 0) {
      sampled += count_voxel(grid, first, last);
    }
  });
  if (sampled == 0) {
    return 0;
  }
  std::uint64_t all = 0;
  for_own_voxels(grid, [&](std::uint32_t /*voxel*/, std::uint32_t first, std::uint32_t last) {
    all += count_voxel(grid, first, last);
  });
  return all;
}

}  // namespace roomcut::ingest

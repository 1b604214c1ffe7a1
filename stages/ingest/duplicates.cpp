// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/duplicates.h"

#include <algorithm>
#include <bit>

namespace roomcut::ingest {

namespace {

constexpr std::size_t kMostKeys = 1U << 16U;

}  // namespace

std::uint64_t key_of_point(float x, float y, float z) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;
  std::uint64_t key = std::uint64_t{std::bit_cast<std::uint32_t>(x)} << 32U | std::bit_cast<std::uint32_t>(y);
  key *= kOdd;
  key ^= key >> 32U;
  key += std::bit_cast<std::uint32_t>(z);
  key *= kOdd;
  return key ^ key >> 29U;
}

void DuplicateSample::add(const LocalPoints& points) {
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const std::uint64_t key = key_of_point(points.x[i], points.y[i], points.z[i]);
    if ((key & mask_) == 0) {
      keys_.push_back(key);
      thin();
    }
  }
}

void DuplicateSample::add(const DuplicateSample& other) {
  mask_ |= other.mask_;
  keys_.insert(keys_.end(), other.keys_.begin(), other.keys_.end());
  std::erase_if(keys_, [&](std::uint64_t key) { return (key & mask_) != 0; });
  thin();
}

/// Takes ever fewer coordinates while these are too many: which ones remain depends on all of them alone.
void DuplicateSample::thin() {
  while (keys_.size() > kMostKeys && mask_ != ~std::uint64_t{0}) {
    mask_ = mask_ << 1U | 1U;
    std::erase_if(keys_, [&](std::uint64_t key) { return (key & mask_) != 0; });
  }
}

double DuplicateSample::share() const {
  std::vector<std::uint64_t> keys = keys_;
  std::sort(keys.begin(), keys.end());
  const auto repeated = keys.end() - std::unique(keys.begin(), keys.end());
  return keys.empty() ? 0 : static_cast<double>(repeated) / static_cast<double>(keys.size());
}

}  // namespace roomcut::ingest

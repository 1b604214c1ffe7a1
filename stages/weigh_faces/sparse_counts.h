// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace roomcut::weigh_faces {

/// A long array of counters of which only the touched blocks take memory. add() may be called by any number
/// of threads; integer sums make the result independent of their order.
class SparseCounts {
 public:
  static constexpr std::size_t kBlock = 1024;  ///< counters per block

  explicit SparseCounts(std::size_t size) : blocks_((size + kBlock - 1) / kBlock) {
    table_ = std::make_unique<std::atomic<std::atomic<std::uint32_t>*>[]>(blocks_);
  }
  ~SparseCounts() {
    for (std::size_t b = 0; b < blocks_; ++b) {
      delete[] table_[b].load(std::memory_order_relaxed);
    }
  }
  SparseCounts(const SparseCounts&) = delete;
  SparseCounts& operator=(const SparseCounts&) = delete;

  void add(std::size_t index) {
    std::atomic<std::uint32_t>* block = table_[index / kBlock].load(std::memory_order_acquire);
    if (block == nullptr) {
      block = make_block(index / kBlock);
    }
    block[index % kBlock].fetch_add(1, std::memory_order_relaxed);
  }
  /// To be called after all add() have ended.
  std::uint32_t at(std::size_t index) const {
    const std::atomic<std::uint32_t>* block = table_[index / kBlock].load(std::memory_order_relaxed);
    return block == nullptr ? 0 : block[index % kBlock].load(std::memory_order_relaxed);
  }
  /// Calls visit(index, count) for the counters of [begin, end) that are not 0, ascending. Likewise.
  template <class Visit>
  void for_each(std::size_t begin, std::size_t end, Visit&& visit) const {
    for (std::size_t b = begin / kBlock; b * kBlock < end; ++b) {
      const std::atomic<std::uint32_t>* block = table_[b].load(std::memory_order_relaxed);
      if (block == nullptr) {
        continue;
      }
      const std::size_t last = std::min(end, (b + 1) * kBlock);
      for (std::size_t i = std::max(begin, b * kBlock); i < last; ++i) {
        const std::uint32_t count = block[i % kBlock].load(std::memory_order_relaxed);
        if (count > 0) {
          visit(i, count);
        }
      }
    }
  }

 private:
  std::atomic<std::uint32_t>* make_block(std::size_t number) {
    auto* fresh = new std::atomic<std::uint32_t>[kBlock]();
    std::atomic<std::uint32_t>* expected = nullptr;
    if (table_[number].compare_exchange_strong(expected, fresh, std::memory_order_acq_rel)) {
      return fresh;
    }
    delete[] fresh;  // another thread was first
    return expected;
  }

  std::size_t blocks_;
  std::unique_ptr<std::atomic<std::atomic<std::uint32_t>*>[]> table_;
};

}  // namespace roomcut::weigh_faces

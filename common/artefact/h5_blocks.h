// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/artefact/h5_content.h"

/// Checksums for blocks of datasets that are too large to be hashed whenever they are opened. A group G that
/// has them holds G/block_offset (u64, blocks + 1: block b is rows [offset[b], offset[b + 1])) and G/checksum
/// (u64, blocks × columns); a dataset of G with the attribute `checksum_column` has its sums in that column.
/// The payload digest covers the table; whoever reads a block compares it with the table.
namespace roomcut::h5 {

/// Checksum of a sequence of bytes that come in pieces: XXH3, 64 bits, seed 0.
class Checksum {
 public:
  Checksum();
  ~Checksum();
  Checksum(Checksum&&) noexcept;
  void update(const void* data, std::size_t bytes);
  /// Of all bytes since the last call, or since the beginning.
  std::uint64_t take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::uint64_t checksum_of(const void* data, std::size_t bytes);

/// The table of one group.
struct BlockTable {
  std::vector<std::uint64_t> offset;  ///< blocks + 1, ascending from 0
  std::vector<std::uint64_t> sums;    ///< blocks × columns
  std::uint64_t columns = 0;
  std::uint64_t sum(std::size_t block, std::uint64_t column) const { return sums[block * columns + column]; }
};

/// Errors: kArtefactDamaged when the table is missing, or its offsets or shape are wrong.
BlockTable read_blocks(const Content& content, const std::string& group);

/// Throws kArtefactDamaged, naming dataset and block, unless all blocks of all datasets that have checksums
/// have theirs. In parallel on TBB; memory: a megabyte per thread. Returns at once when there are none.
void check_all_blocks(const Content& content);

/// kArtefactDamaged for a block that has not its checksum.
[[noreturn]] void throw_damaged_block(const Content& content, const std::string& dataset, std::size_t block);

}  // namespace roomcut::h5

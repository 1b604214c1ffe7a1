// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/h5_blocks.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#define XXH_STATIC_LINKING_ONLY  // a state that needs no allocation
#include <xxhash.h>

#include <algorithm>

#include "common/artefact/artefact_check.h"

namespace roomcut::h5 {

struct Checksum::State {
  XXH3_state_t state;
};

Checksum::Checksum() : state_(std::make_unique<State>()) {
  XXH3_64bits_reset(&state_->state);
}
Checksum::~Checksum() = default;
Checksum::Checksum(Checksum&&) noexcept = default;

void Checksum::update(const void* data, std::size_t bytes) {
  XXH3_64bits_update(&state_->state, data, bytes);
}

std::uint64_t Checksum::take() {
  const std::uint64_t sum = XXH3_64bits_digest(&state_->state);
  XXH3_64bits_reset(&state_->state);
  return sum;
}

std::uint64_t checksum_of(const void* data, std::size_t bytes) {
  return XXH3_64bits(data, bytes);
}

namespace {

std::vector<std::uint64_t> read_whole(const Content& content, const std::string& path,
                                      const StoredDataset& dataset) {
  if (dataset.type != "u64") {
    throw_damaged(content.path(), path, "the dataset holds another type of number");
  }
  std::vector<std::uint64_t> values(dataset.bytes / sizeof(std::uint64_t));
  content.read(path, dataset, 0, dataset.bytes, values.data());
  return values;
}

/// A dataset with checksums, and what is known of it.
struct Summed {
  std::string path;
  const StoredDataset& dataset;
  std::uint64_t column;
  std::uint64_t row_bytes;
};

std::uint64_t sum_of(const Content& content, const Summed& summed, std::uint64_t first, std::uint64_t last,
                     std::vector<char>& piece) {
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;
  Checksum checksum;
  for (std::uint64_t at = first * summed.row_bytes, end = last * summed.row_bytes; at < end; at += kPiece) {
    piece.resize(std::min(kPiece, end - at));
    content.read(summed.path, summed.dataset, at, piece.size(), piece.data());
    checksum.update(piece.data(), piece.size());
  }
  return checksum.take();
}

void check_blocks(const Content& content, const Summed& summed, const BlockTable& table) {
  const std::size_t blocks = table.offset.size() - 1;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks), [&](const auto& range) {
    std::vector<char> piece;
    for (std::size_t b = range.begin(); b < range.end(); ++b) {
      const std::uint64_t sum = sum_of(content, summed, table.offset[b], table.offset[b + 1], piece);
      if (kDigestsCount && sum != table.sum(b, summed.column)) {
        throw_damaged_block(content, summed.path, b);
      }
    }
  });
}

}  // namespace

void throw_damaged_block(const Content& content, const std::string& dataset, std::size_t block) {
  throw_damaged(content.path(), absolute_path(dataset),
                "block " + std::to_string(block) +
                    " does not have its checksum: the file was damaged or changed after it was written");
}

BlockTable read_blocks(const Content& content, const std::string& group) {
  const std::string offset_path = absolute_path(group) + "/block_offset";
  const std::string sums_path = absolute_path(group) + "/checksum";
  BlockTable table;
  table.offset = read_whole(content, offset_path, content.dataset(offset_path));
  if (table.offset.empty() || table.offset.front() != 0 ||
      !std::is_sorted(table.offset.begin(), table.offset.end())) {
    throw_damaged(content.path(), offset_path, "is not ascending from 0");
  }
  const StoredDataset& sums = content.dataset(sums_path);
  if (sums.shape.size() != 2 || sums.shape[0] != table.offset.size() - 1) {
    throw_damaged(content.path(), sums_path, "has not one row per block");
  }
  table.columns = sums.shape[1];
  table.sums = read_whole(content, sums_path, sums);
  return table;
}

void check_all_blocks(const Content& content) {
  for (const auto& [path, object] : content.objects()) {
    if (!object.dataset || !object.attributes.contains(kChecksumColumn)) {
      continue;
    }
    const BlockTable table = read_blocks(content, path.substr(0, path.rfind('/')));
    const StoredDataset& dataset = *object.dataset;
    const std::int64_t column = content.attribute<std::int64_t>(path, kChecksumColumn);
    if (column < 0 || static_cast<std::uint64_t>(column) >= table.columns ||
        dataset.shape[0] != table.offset.back()) {
      throw_damaged(content.path(), path, "the table of checksums does not fit the dataset");
    }
    const std::uint64_t row_bytes = dataset.shape[0] > 0 ? dataset.bytes / dataset.shape[0] : 0;
    check_blocks(content, {path, dataset, static_cast<std::uint64_t>(column), row_bytes}, table);
  }
}

}  // namespace roomcut::h5

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/ingest/scan_bytes.h"

namespace roomcut::ingest {

/// Walks through a file in big blocks, for records whose size only shows on the way.
class ByteCursor {
 public:
  ByteCursor(const ScanBytes& file, std::uint64_t offset) : file_(file), offset_(offset) {}

  std::uint64_t offset() const { return offset_; }
  /// The next `bytes` bytes (at most a few), or nullptr when the file ends before.
  const unsigned char* peek(std::size_t bytes) {
    if (offset_ < begin_ || offset_ + bytes > begin_ + buffer_.size()) {
      refill();
    }
    const bool enough = offset_ + bytes <= begin_ + buffer_.size();
    return enough ? buffer_.data() + (offset_ - begin_) : nullptr;
  }
  /// Moves on, also beyond the end: the next peek() says so.
  void skip(std::uint64_t bytes) { offset_ += bytes; }

 private:
  void refill() {
    constexpr std::size_t kBlock = 1 << 20;
    begin_ = offset_;
    buffer_.resize(kBlock);
    buffer_.resize(file_.read(offset_, buffer_.data(), kBlock));
  }

  const ScanBytes& file_;
  std::uint64_t offset_;
  std::uint64_t begin_ = 0;
  std::vector<unsigned char> buffer_;
};

}  // namespace roomcut::ingest

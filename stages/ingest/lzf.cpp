// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/lzf.h"

#include <algorithm>
#include <vector>

#include "stages/ingest/byte_cursor.h"

namespace roomcut::ingest {

namespace {

constexpr std::size_t kWindow = 1 << 13;  // how far back a reference reaches
constexpr std::size_t kFlush = 1 << 20;
constexpr unsigned kLiterals = 32;  // control bytes below are runs of literals
constexpr std::size_t kLongLength = 7;

/// Bytes that were decompressed, the last 8 KiB of them kept for references.
class Window {
 public:
  explicit Window(const TakeBytes& take) : take_(take) { held_.reserve(kFlush + kWindow + kWindow); }
  std::uint64_t total() const { return given_ + held_.size() - kept_; }
  std::size_t reach() const { return held_.size(); }

  void literal(unsigned char byte) { held_.push_back(static_cast<std::byte>(byte)); }
  void repeat(std::size_t distance, std::size_t length) {
    for (std::size_t i = 0; i < length; ++i) {  // may overlap itself: a run
      held_.push_back(held_[held_.size() - distance]);
    }
  }
  void flush(bool all) {
    if (!all && held_.size() < kFlush) {
      return;
    }
    take_(std::span(held_).subspan(kept_));
    given_ += held_.size() - kept_;
    const std::size_t keep = std::min(kWindow, held_.size());
    held_.erase(held_.begin(), held_.end() - static_cast<std::ptrdiff_t>(keep));
    kept_ = keep;
  }

 private:
  const TakeBytes& take_;
  std::vector<std::byte> held_;
  std::size_t kept_ = 0;  ///< at the front of held_, given already
  std::uint64_t given_ = 0;
};

}  // namespace

std::uint64_t decompress_lzf(const ScanBytes& file, std::uint64_t begin, std::uint64_t size,
                             std::uint64_t most, const TakeBytes& take) {
  ByteCursor cursor(file, begin);
  const std::uint64_t end = begin + size;
  Window window(take);
  const auto next = [&](unsigned char& byte) {
    const unsigned char* bytes = cursor.offset() < end ? cursor.peek(1) : nullptr;
    byte = bytes == nullptr ? 0 : *bytes;
    cursor.skip(1);
    return bytes != nullptr;
  };
  unsigned char control = 0;
  while (window.total() <= most && next(control)) {
    unsigned char byte = 0;
    if (control < kLiterals) {
      for (unsigned i = 0; i <= control && next(byte); ++i) {
        window.literal(byte);
      }
    } else {
      std::size_t length = control >> 5U;
      if (length == kLongLength && next(byte)) {
        length += byte;
      }
      if (!next(byte)) {
        break;
      }
      const std::size_t distance = ((control & 31U) << 8U | byte) + std::size_t{1};
      if (distance > window.reach()) {
        break;
      }
      window.repeat(distance, length + 2);
    }
    window.flush(false);
  }
  window.flush(true);
  return window.total();
}

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "stages/ingest/scan_bytes.h"
#include "stages/ingest/scratch_file.h"

namespace roomcut::ingest {

/// What a decoder gives, one byte after the other, kept in a scratch file for being read at any place.
class SpooledBytes : public ScanBytes {
 public:
  /// `name` is the scan's; the scratch file is made in `folder` with the first bytes.
  SpooledBytes(std::string name, const std::filesystem::path& folder)
      : name_(std::move(name)), scratch_(folder) {}

  /// Adds bytes; not thread-safe, and not to be mixed with reading. Errors: kCannotWrite.
  void append(std::span<const std::byte> bytes) {
    scratch_.write(size_, bytes);
    size_ += bytes.size();
  }

  std::uint64_t size() const override { return size_; }
  std::string name() const override { return name_; }
  std::size_t read(std::uint64_t offset, void* out, std::size_t bytes) const override {
    if (offset >= size_) {
      return 0;
    }
    bytes = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, size_ - offset));
    scratch_.read(offset, {static_cast<std::byte*>(out), bytes});
    return bytes;
  }

 private:
  std::string name_;
  ScratchFile scratch_;
  std::uint64_t size_ = 0;
};

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "stages/ingest/scan_bytes.h"

namespace roomcut::ingest {

/// A text file as plain lines: one byte a character, each line ended by '\n', no byte-order mark.
/// UTF-16 of either byte order (told by its mark, or by every second byte being 0) is taken character by
/// character, so that places can still be computed; what is not ASCII in it becomes '?', which no number
/// needs. Lone carriage returns, where the first 256 KiB have some, are line ends; "\r\n" stays as it is.
class TextBytes : public ScanBytes {
 public:
  /// Errors: those of reading `file`.
  explicit TextBytes(std::shared_ptr<const ScanBytes> file);

  std::uint64_t size() const override { return size_; }
  std::string name() const override { return file_->name(); }
  std::size_t read(std::uint64_t offset, void* out, std::size_t bytes) const override;
  /// Whether places here are those in the file: it is no UTF-16 and has no byte-order mark.
  bool same_places() const { return begin_ == 0 && width_ == 1; }

 private:
  void find_encoding();
  std::size_t read_wide(std::uint64_t offset, char* out, std::size_t bytes) const;
  bool has_lone_returns() const;

  std::shared_ptr<const ScanBytes> file_;
  std::uint64_t begin_ = 0;  ///< behind the byte-order mark
  std::size_t width_ = 1;    ///< bytes of a character
  bool big_endian_ = false;
  bool returns_end_lines_ = false;
  std::uint64_t size_ = 0;
};

}  // namespace roomcut::ingest

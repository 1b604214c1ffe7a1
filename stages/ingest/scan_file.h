// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "stages/ingest/scan_bytes.h"

namespace roomcut::ingest {

/// A scan opened for reading at any place, by several threads at once. Nothing is held in memory.
class ScanFile : public ScanBytes {
 public:
  /// Errors: kScanMissing (no such file, a directory), kScanUnreadable (permission, not a regular file),
  /// kScanEmpty.
  explicit ScanFile(const std::filesystem::path& path);
  ~ScanFile() override;
  ScanFile(const ScanFile&) = delete;
  ScanFile& operator=(const ScanFile&) = delete;

  std::uint64_t size() const override { return size_; }
  std::string name() const override { return path_.string(); }
  const std::filesystem::path& path() const { return path_; }

  /// Errors: kScanUnreadable (I/O error), kScanTruncated (the file has shrunk meanwhile).
  std::size_t read(std::uint64_t offset, void* out, std::size_t bytes) const override;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace roomcut::ingest

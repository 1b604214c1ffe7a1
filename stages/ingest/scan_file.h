// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace roomcut {

/// A scan opened for reading at any place, by several threads at once. Nothing is held in memory.
class ScanFile {
 public:
  /// Errors: kScanMissing (no such file, a directory), kScanUnreadable (permission, not a regular file),
  /// kScanEmpty.
  explicit ScanFile(const std::filesystem::path& path);
  ~ScanFile();
  ScanFile(const ScanFile&) = delete;
  ScanFile& operator=(const ScanFile&) = delete;

  std::uint64_t size() const { return size_; }
  /// The name as messages give it.
  std::string name() const { return path_.string(); }
  const std::filesystem::path& path() const { return path_; }

  /// Reads up to `bytes` bytes from `offset`; returns how many there were. Thread-safe.
  /// Errors: kScanUnreadable (I/O error), kScanTruncated (the file has shrunk meanwhile).
  std::size_t read(std::uint64_t offset, void* out, std::size_t bytes) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace roomcut

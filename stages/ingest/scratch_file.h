// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>

namespace roomcut::ingest {

/// A file without a name for points that shall not stay in memory: it goes with the process, however that
/// ends.
class ScratchFile {
 public:
  /// Made in `folder` with the first write.
  explicit ScratchFile(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// Thread-safe for different places, like read(). Errors: kCannotWrite.
  void write(std::uint64_t offset, std::span<const std::byte> bytes);
  /// What was written there. Errors: likewise.
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::once_flag made_;
  int descriptor_ = -1;
};

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include "stages/tools/view/request_rules.h"

namespace roomcut::view {

/// A file that is open for reading, by its descriptor: it stays the same file when another one takes its
/// name.
class OpenFile {
 public:
  explicit OpenFile(int descriptor = -1) : descriptor_(descriptor) {}
  ~OpenFile();
  OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  OpenFile& operator=(OpenFile&& other) noexcept;
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int descriptor() const { return descriptor_; }
  /// Its size; nullopt when it is no regular file, or none is open [bytes].
  std::optional<std::uint64_t> size() const;
  /// Fills `bytes` from `offset` on. False when the file ends before, or cannot be read.
  bool read(std::uint64_t offset, char* bytes, std::size_t count) const;

 private:
  int descriptor_;
};

/// Opens a file of the work folder; nullopt when it is not there or not a regular file. No symbolic link is
/// followed, neither as the file nor as its folder: a link could lead out of the work folder.
std::optional<OpenFile> open_work_file(const std::filesystem::path& work, const ServedFile& file);

}  // namespace roomcut::view

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "common/artefact/atomic_file.h"

namespace roomcut::synthesize {

/// A file that is written from front to back, parts of which may be written again at the end; it gets its
/// name when it is complete. Every function throws StageError(kCannotWrite).
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  std::uint64_t size() const { return size_; }  ///< bytes written by write()
  /// Puts `text` over as many bytes that were written at `place`; writing then goes on behind the last one.
  void overwrite(std::uint64_t place, std::string_view text);
  void commit();

 private:
  void check(bool good) const;
  AtomicFile file_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
  std::uint64_t size_ = 0;
};

/// The shortest text that gives the same number again.
std::string shortest(double value);

}  // namespace roomcut::synthesize

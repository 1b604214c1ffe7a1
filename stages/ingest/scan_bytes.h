// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace roomcut::ingest {

/// Bytes that can be read at any place, by several threads at once: those of a file, or what they stand for.
class ScanBytes {
 public:
  virtual ~ScanBytes() = default;
  virtual std::uint64_t size() const = 0;
  /// The name as messages give it.
  virtual std::string name() const = 0;
  /// Reads up to `bytes` bytes from `offset`; returns how many there were: fewer only at the end.
  virtual std::size_t read(std::uint64_t offset, void* out, std::size_t bytes) const = 0;
};

}  // namespace roomcut::ingest

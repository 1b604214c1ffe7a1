// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace roomcut::view {

/// A part of a file: never beyond its end.
struct ByteRange {
  std::uint64_t offset = 0, length = 0;  ///< [bytes]
  bool whole = true;                     ///< nothing was asked for, or nothing that is understood
};

/// What the header Range ("bytes=5-9", "bytes=5-", "bytes=-5"; "" = none) asks of a file of `size` bytes,
/// clamped to the file. Several ranges and other units get the whole file, as HTTP allows. nullopt: none of
/// it lies in the file (416).
std::optional<ByteRange> byte_range(std::string_view header, std::uint64_t size);

}  // namespace roomcut::view

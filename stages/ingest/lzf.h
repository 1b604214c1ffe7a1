// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "stages/ingest/scan_bytes.h"

namespace roomcut::ingest {

/// Takes the next decompressed bytes.
using TakeBytes = std::function<void(std::span<const std::byte>)>;

/// Decompresses LZF data (as in PCD files) in [begin, begin + size) of `file`, about a megabyte at a time.
/// Returns how many bytes it gave; stops beyond `most`. Damaged data (a reference before the beginning, an
/// end in the middle) end it early: the number is then not the expected one.
std::uint64_t decompress_lzf(const ScanBytes& file, std::uint64_t begin, std::uint64_t size,
                             std::uint64_t most, const TakeBytes& take);

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "stages/ingest/scan_bytes.h"

namespace roomcut::ingest {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

/// Number of the line that begins at `offset`, counted from 1.
std::uint64_t line_number(const ScanBytes& text, std::uint64_t offset);

/// Where the `lines`-th line that is not blank ends, from `begin` on. `found` is how many there were.
std::uint64_t end_of_lines(const ScanBytes& text, std::uint64_t begin, std::uint64_t lines,
                           std::uint64_t& found);

}  // namespace roomcut::ingest

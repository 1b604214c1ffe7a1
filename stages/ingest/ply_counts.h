// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/ply/ply_header.h"
#include "stages/ingest/scan_bytes.h"

namespace roomcut::ingest {

/// Throws kScanTruncated: fewer elements than the header promises; `found` is a count, or words for it.
[[noreturn]] void too_few(const ScanBytes& file, const PlyElement& element, const std::string& found);

/// Throws kScanTruncated: more elements than the header promises. A writer that puts the count last, or
/// failed to, leaves such files; to read as many as promised would be half a scan without a word.
[[noreturn]] void too_many(const ScanBytes& file, const PlyElement& element, const std::string& found);

/// The elements after the vertices that promise anything, e.g. faces; 0 when the vertices are the last.
std::size_t elements_after_vertices(const PlyHeader& header);

}  // namespace roomcut::ingest

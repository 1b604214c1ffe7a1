// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string_view>

#include "stages/ingest/scan_reader.h"
#include "stages/ingest/text_bytes.h"

namespace roomcut::ingest {

/// A PLY file: ascii, binary little or big endian; x, y, z (and nx, ny, nz) of any scalar type; other
/// properties, lists and elements are skipped. `text` is the same file as lines. Bytes behind the last
/// element are a warning; from the size of a vertex on the header's count is wrong: kScanTruncated. Other
/// errors: kScanFormat, kScanTruncated (fewer than promised), kScanNoPoints.
std::unique_ptr<ScanReader> open_ply(const std::shared_ptr<const ScanBytes>& file,
                                     const std::shared_ptr<const TextBytes>& text);

/// Whether a file that begins so is a PLY.
bool is_ply(std::string_view head);

}  // namespace roomcut::ingest

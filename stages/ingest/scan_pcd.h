// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "stages/ingest/scan_reader.h"
#include "stages/ingest/text_bytes.h"

namespace roomcut::ingest {

/// A PCD file: ascii, binary or binary_compressed; x, y, z (and normal_x, normal_y, normal_z) of any type but
/// 64-bit integers; other fields are skipped. `text` is the same file as lines. A VIEWPOINT without rotation
/// is a scanner position. Compressed points go through a scratch file in `scratch_folder`. Errors:
/// kScanFormat, kScanTruncated (fewer points than promised, or more), kScanNoPoints.
std::unique_ptr<ScanReader> open_pcd(const std::shared_ptr<const ScanBytes>& file,
                                     const std::shared_ptr<const TextBytes>& text,
                                     const std::filesystem::path& scratch_folder);

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "stages/ingest/scan_reader.h"

namespace roomcut {

/// A PLY file: ascii, binary little or big endian; x, y, z (and nx, ny, nz) of any scalar type; other
/// properties, lists and elements are skipped. Errors: kScanFormat, kScanTruncated, kScanNoPoints.
std::unique_ptr<ScanReader> open_ply(const std::shared_ptr<const ScanFile>& file);

}  // namespace roomcut

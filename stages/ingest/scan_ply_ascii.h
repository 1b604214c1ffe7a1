// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "stages/ingest/ply_columns.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut::ingest {

/// The body of an ascii PLY: one vertex per line. `text` has the header's places. Errors: kScanTruncated when
/// the header promises more than there is, or fewer: whole points beyond its count. Lines beyond it that are
/// no points are a warning.
std::unique_ptr<ScanReader> open_ascii_ply(const std::shared_ptr<const ScanBytes>& text,
                                           const PlyHeader& header, const PlyColumns& columns);

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "stages/ingest/ply_columns.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut {

/// A cloud as plain text: .xyz .txt .csv .pts .asc; separators space, tab, comma or semicolon, decimal point;
/// columns by a line of names, else the first three. Lines are read in parallel. Errors: those of
/// sniff_text(); reading a block: kScanBadLine with the line's number.
std::unique_ptr<ScanReader> open_text(const std::shared_ptr<const ScanFile>& file);

/// The body of an ascii PLY: one vertex per line. Errors: kScanTruncated.
std::unique_ptr<ScanReader> open_ascii_ply(const std::shared_ptr<const ScanFile>& file,
                                           const PlyHeader& header, const PlyColumns& columns);

}  // namespace roomcut

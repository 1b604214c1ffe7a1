// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "stages/ingest/scan_reader.h"
#include "stages/ingest/text_layout.h"

namespace roomcut::ingest {

/// A cloud as plain text: .xyz .txt .csv .pts .asc; separators space, tab, comma or semicolon; decimal point
/// or comma. Columns are those that the user names, else by a line of names, else the first three; which they
/// are is among the reader's notes. Lines are read in parallel. Errors: those of sniff_text(); reading a
/// block: kScanBadLine with the line's number; check_total(): kScanTruncated when count lines promise more or
/// fewer points than there are.
std::unique_ptr<ScanReader> open_text(const std::shared_ptr<const ScanBytes>& text,
                                      const std::vector<int>& columns = {});

/// The lines of `text` from layout.begin to layout.end, one point each. Errors: as those of open_text()'s
/// blocks.
std::unique_ptr<ScanReader> text_reader(const std::shared_ptr<const ScanBytes>& text,
                                        const TextLayout& layout, const std::vector<Vec3>& stations);

}  // namespace roomcut::ingest

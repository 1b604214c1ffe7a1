// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "stages/ingest/scan_reader.h"

namespace roomcut::ingest {

/// Whether a text is a PTX file: two counts, then lines of three, three, three, three, four … numbers.
bool is_ptx(const ScanBytes& text);

/// A PTX file: scans one after the other, each with the numbers of its columns and rows, its position, axes
/// and a 4 × 4 matrix (row vectors) that brings its points into common coordinates. `0 0 0` is a beam without
/// return: dropped and counted. The scanner positions are the matrices' translations, or where a matrix is
/// the identity the position that the scan states, unless that is 0 0 0. Errors: kScanFormat (a matrix that
/// is no rotation and translation: it must not become the identity), kScanTruncated (fewer points than
/// columns × rows, or more).
std::unique_ptr<ScanReader> open_ptx(const std::shared_ptr<const ScanBytes>& text);

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string_view>

#include "stages/ingest/scan_file.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut::ingest {

/// The decoder for a file that begins so: "e57" or "las" (LAS and LAZ); nullptr when it needs none.
const char* decoder_of(std::string_view head);

/// A scan that a decoder reads: a program of options.decoders (decoders/<name>.py, run by
/// python/bin/python3), which gives points in common coordinates through a pipe, block by block. They are
/// kept in a scratch file in options.scratch_folder, 12 to 36 bytes each; blocks can be read while later ones
/// are decoded. Errors: kScanNoDecoder (no environment), kScanTruncated (more points promised than eight per
/// byte), those that the decoder states (kScanFormat, kScanTruncated, kScanNoPoints), kScanFormat when it
/// dies or is stopped, kCannotWrite; once the points have begun, they come from read() and check_total().
std::unique_ptr<ScanReader> open_decoded(const ScanFile& file, const std::string& decoder,
                                         const ScanOptions& options);

}  // namespace roomcut::ingest

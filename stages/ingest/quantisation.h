// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/ingest/scan_frame.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut::ingest {

/// The largest step of 1, 2, 5 … times 0.1 mm to 0.5 m, or of those of float32 numbers (31, 62, 125, 250 mm),
/// of which the coordinates along some axis are multiples (up to an offset), or the spacing of float32
/// numbers at the scan's place, if that is larger [m]; 0 when there is none. Points that were rounded so can
/// look like a plane without noise: the noise is never taken below step / sqrt(12).
double quantisation_step(const ScanBlock& sample, const ScanFrame& frame, const ScanReader& reader);

}  // namespace roomcut::ingest

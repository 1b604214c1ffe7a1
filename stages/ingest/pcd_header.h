// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/ingest/scan_bytes.h"

namespace roomcut {

/// Whether the file is a PCD: it begins with a comment that says so, or a line of FIELDS and one of DATA
/// stand among the first. The format asks for no comment and no order.
bool is_pcd(const ScanBytes& text);

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/geometry/scan_coordinates.h"
#include "common/wall_lines/compare_lines.h"

namespace roomcut {

/// "w0012 (3.42 m, from (1.20, 4.50) to (4.62, 4.50))": in the scan's own coordinates, as the files are.
std::string describe(const WallLine& line, const ScanCoordinates& scan);

/// "w0007 moved by 104.0 mm, turned by 0.00 deg"; a line that only became longer or shorter says so: "w0007
/// kept its place, its ends moved by 30.0 mm".
std::string describe(const LineMove& move);

/// What an edit does: one line of text per line that was moved, added, deleted or locked, and a last one
/// with the counts. `frame` is that of both.
std::vector<std::string> describe_changes(const LineDifferences& changes,
                                          const std::vector<WallLine>& detected,
                                          const std::vector<WallLine>& edited, const Frame& frame);

}  // namespace roomcut

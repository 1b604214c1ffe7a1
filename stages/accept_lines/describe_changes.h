// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/accept_lines/accept_lines.h"

namespace roomcut {

/// "w0012 (3.42 m, from (1.20, 4.50) to (4.62, 4.50))"
std::string describe(const WallLine& line);

/// "w0007 moved by 0.104 m, turned by 0.00 deg"; a line that only became longer or shorter says so.
std::string describe(const LineMove& move);

/// One line of text per line that was added, moved or deleted, and a last one with the counts.
std::vector<std::string> describe_changes(const LineDifferences& changes,
                                          const std::vector<WallLine>& detected,
                                          const std::vector<WallLine>& edited);

/// The warning for an edit whose base has moved on: what to do, and at most `most` lines of what differs.
std::string describe_moved_base(const Acceptance& acceptance, const std::string& detection_sha256,
                                std::size_t most = 20);

}  // namespace roomcut

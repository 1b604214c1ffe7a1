// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/wall_lines/wall_line.h"

namespace roomcut::accept_lines {

/// Gives what was edited of curved walls its sense. A chord that was moved, and a line that only has a
/// chord's properties (a copy), leaves the arc. Another radius or centre on any of an arc's chords is the
/// arc's: all chords that it still has are made anew on it, at the azimuths that they had, locked ones too,
/// and count as edited. A chord that was deleted stays deleted. Returns what was done, in words; warns there
/// of values that contradict each other, where those of the first chord by id count.
std::vector<std::string> apply_arc_edits(const WallLines& detected, WallLines& edit);

}  // namespace roomcut::accept_lines

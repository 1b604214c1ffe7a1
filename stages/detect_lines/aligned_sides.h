// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/detect_lines/merge_lines.h"

namespace roomcut::detect_lines {

/// A short face: one side of a column, of a niche, of a pilaster.
struct Side {
  Line2 line;
  Support support;
  std::string column;  ///< name of the column; empty = of none
};

/// Makes lines of sides: those in a row, of the same direction, with offsets that differ by `aligned_m` at
/// most and with gaps of 25 of their lengths and 10 m at most, are one line; farther apart they keep one
/// offset. Beside lines a millimetre apart stand slivers that no later stage can tell from walls. Strongest
/// first.
std::vector<LineCandidate> align_sides(std::vector<Side> sides, double aligned_m);

}  // namespace roomcut::detect_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/wall_lines/compare_lines.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut::accept_lines {

/// What goes on to the partition, and what the user did to it.
struct Acceptance {
  WallLines lines;          ///< normalised: the edit's lines if there is an edit, else the detected ones
  LineDifferences changes;  ///< of the edit against the detection; empty without an edit
  std::vector<std::string> arcs;  ///< what became of edited curved walls, in words
  int locked = 0;
  bool base_moved = false;              ///< the edit began from another detection than today's
  std::vector<WallLine> only_detected;  ///< then: lines of the detection that the edit has nothing near
  std::vector<WallLine> only_edited;    ///< … and of the edit that the detection has nothing near
};

/// Accepts the edit if there is one, otherwise the detection. `detection_sha256` is the payload digest of the
/// detected lines; the result carries the digest of the detection that its lines began from as base_sha256,
/// so that a copy of it can be edited again. An edit that doesn't name its base counts as begun from this
/// detection.
Acceptance accept_lines(const WallLines& detected, const std::string& detection_sha256,
                        const std::optional<WallLines>& edit);

/// Those of `lines` that have no partner in `others` within 3 cm and 2 degrees over a common stretch: closer
/// than any two faces of a wall, wider than a repeated detection shifts a line.
std::vector<WallLine> without_partner(const std::vector<WallLine>& lines,
                                      const std::vector<WallLine>& others);

/// The warning for an edit whose base has moved on: what to do, and at most `most` lines of what differs.
std::string describe_moved_base(const Acceptance& acceptance, const std::string& detection_sha256,
                                std::size_t most = 20);

}  // namespace roomcut::accept_lines

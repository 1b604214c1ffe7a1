// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/wall_lines/compare_lines.h"
#include "stages/tools/compare/run_facts.h"

namespace roomcut::compare {

/// A parameter that the two runs had with different values; empty where a run does not know it.
struct ParameterDifference {
  std::string parameter;  ///< "graphcut.mu_m"
  std::string a, b;
};

/// Indices of what both runs have, as pairs, and of what only one of them has.
struct Matches {
  std::vector<std::pair<std::size_t, std::size_t>> both;
  std::vector<std::size_t> only_a, only_b;
};

/// One line of both runs, and how far it lies from where A has it.
struct LinePair {
  std::size_t a = 0, b = 0;  ///< indices into the lines of the runs
  LineMove move;
  bool same() const { return move.ends_m <= kSameLine_m; }
};

struct LineMatches {
  std::vector<LinePair> pairs;  ///< those that moved most first
  std::vector<std::size_t> only_a, only_b;
  std::size_t same() const;
};

struct Comparison {
  bool same_scan = false;
  std::vector<ParameterDifference> parameters;  ///< in the order of the pipeline
  LineMatches lines;
  Matches storeys, rooms;
};

/// Which lines of two runs are the same line: by where they lie, since ids are given anew by every detection.
/// Two lines match when they are within 5 degrees and 0.3 m and run beside each other over a third of the
/// shorter one; the nearest match first. Both in the same frame.
LineMatches match_lines(const std::vector<WallLine>& a, const std::vector<WallLine>& b);

/// Storeys match by their floors (within 1 m), the nearest first.
Matches match_storeys(const std::vector<SpaceFacts>& a, const std::vector<SpaceFacts>& b);

/// Rooms match when their centres and floors are within 1 m, the nearest first.
Matches match_rooms(const std::vector<SpaceFacts>& a, const std::vector<SpaceFacts>& b);

/// The lines of `run` in the local coordinates of `frame`.
std::vector<WallLine> lines_in(const RunFacts& run, const Frame& frame);

Comparison compare_runs(const RunFacts& a, const RunFacts& b);

}  // namespace roomcut::compare

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/openings/opening.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut::compare {

/// A storey or a room as summary.json has it, in the scan's coordinates.
struct SpaceFacts {
  int number = 0;  ///< of the storey or of the room
  int storey = 0;
  Vec2 centre{0, 0};  ///< of its plan
  double floor_z = 0, ceiling_z = 0;
  double area_m2 = 0, volume_m3 = 0, height_m = 0, unobserved_m3 = 0;
};

/// The plan of one run: its cells with their labels.
struct RunPlan {
  CellComplex complex;
  Labels labels;
};

/// What one work folder holds, as far as two are compared. What the run had not made yet is empty.
struct RunFacts {
  std::string name;         ///< of the work folder
  std::string scan_sha256;  ///< of the scan's bytes
  bool edited = false;      ///< whether a hand edit is in force
  /// "graphcut.mu_m" and its value as text, in the order of the pipeline; "auto (0.007)" where it was derived
  /// from the scan.
  std::vector<std::pair<std::string, std::string>> parameters;
  Frame frame;
  std::string lines_file;       ///< which lines these are: those refined, else those accepted
  std::vector<WallLine> lines;  ///< local metres
  std::optional<RunPlan> plan;  ///< of the second pass, else of the first
  std::vector<Opening> openings;
  std::vector<SpaceFacts> storeys, rooms;
  /// Figures in their order: "area [m2]" and the like.
  std::vector<std::pair<std::string, double>> totals;
};

}  // namespace roomcut::compare

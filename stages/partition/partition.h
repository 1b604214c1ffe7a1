// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/cells/cell_complex.h"
#include "common/wall_lines/wall_line.h"
#include "stages/partition/params.h"

namespace roomcut::partition {

struct Partition {
  CellComplex complex;
  std::vector<std::string> without_edge;  ///< wall_ids of lines that no edge lies on: doubles of other lines
  std::size_t faces_before_pruning = 0;
};

/// What slopes in a building: the planes, and which levels stand for them alone (one per level; none = none).
struct Slopes {
  std::vector<SlopedPlane> planes;
  std::vector<std::uint8_t> steps;
};

/// Space partitioning of paper §2: cuts the plan's rectangle (bounding box of scan and lines, and a margin)
/// by the wall lines and stacks it between the levels [m, ascending, at least 2]. Lines are cut in by falling
/// support (ties: id), each through the faces that its support, lengthened by extend_m at both ends, enters;
/// then the creases of the sloped planes (find_creases()), which follow the wall lines in complex.lines.
/// Pure function of its arguments. Throws StageError: kNoCells without lines, kLinesDegenerate,
/// kLinesProperty (a wall slice that does not exist), kTooComplex.
Partition partition(const WallLines& lines, const std::vector<double>& levels, const PartitionParams& params,
                    const Slopes& slopes = {});

}  // namespace roomcut::partition

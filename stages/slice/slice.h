// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/slices/slices.h"
#include "stages/slice/open_edges.h"
#include "stages/slice/params.h"
#include "stages/slice/tile_source.h"

namespace roomcut::slice {

/// A value that was derived from the data, by the parameter's formula.
struct SliceChoice {
  std::string parameter;
  double value;
};

struct SliceResult {
  Slices slices;
  std::vector<SliceChoice> choices;
  std::vector<Level>
      rejected;  ///< heights with horizontal surface that were no level: tables, shelves, steps
  std::vector<OpenEdge> open_edges;  ///< they count as walls of the slice below their ceiling
};

/// Horizontal slicing (paper §2): levels from the peaks of the histogram of horizontal area, wall slices
/// between them. Two passes over the points: heights, then wall evidence. Metres; same result for any number
/// of threads. Throws StageError: kNoLevels, kNoVertical, with what was seen.
SliceResult slice_cloud(const CloudHeader& header, const TileSource& tiles, const SliceParams& params);

}  // namespace roomcut::slice

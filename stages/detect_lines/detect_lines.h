// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/slices/slices.h"
#include "common/wall_lines/wall_line.h"
#include "stages/detect_lines/hough.h"
#include "stages/detect_lines/params.h"
#include "stages/detect_lines/wall_cells.h"

namespace roomcut::detect_lines {

/// A value that was derived from the data, by the parameter's formula.
struct DetectLinesChoice {
  std::string parameter;
  double value;
};

/// The accumulator as it was before any line was taken out, made small enough to look at.
struct HoughPicture {
  double angle_step = 0;     ///< [rad]; row a stands for theta in [a, a+1) steps
  double distance_step = 0;  ///< [m]
  double distance0 = 0;      ///< signed distance to `centre` of column 0's lower edge [m]
  Vec2 centre{0, 0};
  std::size_t angles = 0, distances = 0;
  std::vector<float> votes_m;  ///< angles × distances, largest value of the bins that fell together [m]
};

struct DetectLinesResult {
  WallLines lines;  ///< sorted by id
  WallCells cells;  ///< with the line that took each cell
  HoughPicture hough;
  std::vector<DetectLinesChoice> choices;
  std::size_t merged = 0;  ///< near-duplicates that were joined
  std::size_t arcs = 0;    ///< curved walls, whose chords are among the lines
};

/// Wall lines of all wall slices together (paper §2, wall directions): cells that lie linear vote for a
/// window of angles, the highest peak is refitted to its cells and taken out, until less than min_support_m
/// is left; near-duplicates are joined, the two faces of a thin wall are not. Deterministic, any number of
/// threads. Throws StageError(kNoWallLines) with what was seen.
DetectLinesResult detect_lines(const Slices& slices, const DetectLinesParams& params);

}  // namespace roomcut::detect_lines

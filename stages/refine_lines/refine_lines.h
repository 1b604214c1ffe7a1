// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cloud/cloud.h"
#include "common/wall_lines/wall_line.h"
#include "stages/refine_lines/carried_layers.h"
#include "stages/refine_lines/one_sided.h"
#include "stages/refine_lines/params.h"

namespace roomcut::refine_lines {

struct Refinement {
  WallLines lines;
  std::vector<OneSidedWall> one_sided;  ///< as given, each with the id of the line that it is on now
  int dropped = 0;                      ///< detected lines that carry no surface of the first cut
  int merged = 0;                       ///< lines that went into another one
  int split = 0;                        ///< lines made of walls that were taken for a part of another line
  int bends = 0;    ///< walls without a line of their own, found where others leave their line
  int refined = 0;  ///< lines that were adjusted
  int held = 0;     ///< lines that stayed as they came: locked, or too few observations
  int arcs = 0;     ///< curved walls, each refined as one circle
  int classes = 0;  ///< groups of parallel and perpendicular walls
  int observations = 0;
  std::uint64_t points = 0;                        ///< points that were observed
  double median_shift_m = 0, largest_shift_m = 0;  ///< of the refined lines, at their centres
  bool converged = true;  ///< false: Ceres failed, the lines are those of the single fits
};

/// Refines the lines that carry a wall in the first cut, on raw points (README: method). One pass: construct,
/// add() every tile in any order and from any thread, finish(). The result is the same for any order and
/// number of threads.
class LineRefiner {
 public:
  /// `label` as Labels::label of `complex`, which `lines` were partitioned into; `noise_m` of the points off
  /// their plane. All are copied or consumed here, except `complex`, which must outlive the refiner. Throws
  /// StageError(kNoWallLines) when no line carries surface. The lines of walls seen from one side stay
  /// however little surface they carry, and keep their ends unless they are split.
  LineRefiner(const WallLines& lines, const CellComplex& complex, const std::vector<std::uint8_t>& label,
              double noise_m, double density, const RefineLinesParams& params,
              std::vector<OneSidedWall> one_sided = {}, const CarriedRuns& carried = {});
  ~LineRefiner();

  void add(const CloudTile& tile);
  Refinement finish();

  double band_m() const;  ///< what `auto` resolved to
  double merge_m() const;
  double split_m() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roomcut::refine_lines

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/refine_lines/carried_layers.h"

namespace roomcut::refine_lines {

/// Where one line carries the model's surface: its wall faces between an empty and a solid cell, rastered
/// along the line.
struct LineFaces {
  Line2 line;
  double area_m2 = 0;     ///< of those faces
  double t0 = 0, t1 = 0;  ///< hull of those faces along the line [m]; t0 = t1 when there are none
  double bin_m = 0;       ///< raster step, at most the one asked for: short lines get at least ten bins
  std::size_t bins = 0;
  std::size_t layers = 0;
  /// bins × layers: +1 the empty side is the one the normal points to, -1 the other one, 0 no face (or a bin
  /// that is not covered by at least nine tenths).
  std::vector<std::int8_t> side;

  std::int8_t side_at(std::size_t bin, std::size_t layer) const { return side[bin * layers + layer]; }
};

/// The bins [first, end) of `faces`; `layer_height` [m] apportions the area.
LineFaces slice_bins(const LineFaces& faces, std::size_t first, std::size_t end,
                     const std::vector<double>& layer_height);

/// One entry per complex.lines: the faces that are the line's by `carried` (empty: all). `label` as in
/// Labels.
std::vector<LineFaces> find_line_faces(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                                       double bin_m, const CarriedRuns& carried = {});

}  // namespace roomcut::refine_lines

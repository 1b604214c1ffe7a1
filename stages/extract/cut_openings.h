// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/openings/opening.h"

namespace roomcut::extract {

/// An opening as cells of the refined complex.
struct Passage {
  Opening opening;
  std::vector<std::size_t> cells;      ///< that become empty; solid in the closed labels
  std::size_t cell_a = 0, cell_b = 0;  ///< empty cells beside it, at its sill: of the two rooms
  double volume_m3 = 0;                ///< by which it enlarges the empty space
};

/// A complex in which openings are whole cells, and its labels, in which they are still closed.
struct OpenableComplex {
  CellComplex complex;
  Labels labels;
  std::vector<std::size_t> whole;  ///< per cell, the cell of the given complex that it is a part of
  std::vector<Passage> passages;
  std::vector<std::string> refused;  ///< "o0007: why": openings that do not fit the labels; they stay closed
};

/// Refines the complex so that every opening is a set of cells: its jambs cut the plan between the wall's two
/// faces and nowhere else, its head (and sill) become levels. Labels are inherited, so the surface stays the
/// same; then the openings are tried one after the other and accepted where solid cells lie beyond the jambs
/// and empty ones beyond the two faces. What the cut had emptied already becomes solid in the closed labels:
/// cells of an opening, those above it as far as the wall goes on beside both jambs, and those up to 0.2 m
/// beside a jamb. The surface with this and all accepted ones opened must be a 2-manifold. So the result has
/// a watertight surface whichever openings are given. Levels multiply cells, but no ray and no cut sees them:
/// only the surface's extraction.
OpenableComplex cut_openings(const CellComplex& complex, const Labels& labels,
                             const std::vector<Opening>& openings);

/// Labels the passages' cells empty.
void open_passages(const std::vector<Passage>& passages, Labels& labels);

}  // namespace roomcut::extract

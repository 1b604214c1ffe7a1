// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "common/cells/cell_complex.h"
#include "common/picture/image.h"
#include "common/picture/svg.h"

namespace roomcut::report {

/// An empty drawing that shows the whole plan of a complex.
Svg plan_of(const CellComplex& complex);

/// What a cell is filled with, and what its tooltip says.
struct CellLook {
  Colour fill;
  std::string title;
};

/// Fills every face of a layer.
void fill_cells(Svg& svg, const CellComplex& complex, std::size_t layer,
                const std::function<CellLook(std::size_t cell)>& look);

/// Draws every edge: thick where a wall of the model stands, thin elsewhere. Without labels all are thin.
void draw_edges(Svg& svg, const CellComplex& complex, const Labels* labels, std::size_t layer);

/// "2.70 m to 5.70 m": between which heights a layer lies.
std::string heights_of(const CellComplex& complex, std::size_t layer);

}  // namespace roomcut::report

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/picture/colour_map.h"
#include "common/picture/svg.h"
#include "stages/report/pictures.h"

namespace roomcut {

namespace {

constexpr Colour kUnobserved{204, 121, 167}, kWallEdge{20, 20, 20}, kThinEdge{190, 190, 190};

std::string cell_title(const DataTerms& terms, const Labels& labels, std::size_t cell) {
  char text[240];
  std::snprintf(text, sizeof text,
                "cell %zu: %s%s, probability of empty %.2f; odd rays %.2f, above and below %+.2f, around "
                "%+.2f, observed %.2f; "
                "flipping it would cost %.2f m³",
                cell, labels.label[cell] != 0 ? "empty" : "solid",
                labels.unobserved[cell] != 0 ? " (unobserved)" : "", terms.beta[cell], terms.kappa[cell],
                terms.vertical[cell], terms.around[cell], terms.observed[cell], labels.margin_m3[cell]);
  return text;
}

}  // namespace

Picture draw_cells(const CellComplex& complex, const DataTerms& terms, const Labels& labels,
                   std::size_t layer) {
  Vec2 low(1e30, 1e30), high(-1e30, -1e30);
  for (const Vec2& vertex : complex.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  Svg svg(low, high, std::min(60.0, 1000 / (high - low).maxCoeff()));
  std::vector<Vec2> corners;
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    const std::size_t cell = complex.cell(f, layer);
    corners.clear();
    for (auto i = complex.face_offset[f]; i < complex.face_offset[f + 1]; ++i) {
      corners.push_back(complex.vertices[complex.face_vertex[i]]);
    }
    // The margin per volume says how sure the decision is, whatever the cell's size.
    const double volume = complex.area(f) * complex.height(layer);
    const double sure = std::clamp(labels.margin_m3[cell] / std::max(volume, 1e-9), 0.0, 1.0);
    const Colour fill =
        labels.label[cell] != 0 ? diverging_colour(-0.25 - 0.6 * sure) : Colour{225, 225, 225};
    svg.polygon(corners, fill, 1, cell_title(terms, labels, cell));
    if (labels.unobserved[cell] != 0 && labels.label[cell] != 0) {
      svg.polygon(corners, kUnobserved, 0.5);
    }
  }
  const auto empty = [&](std::int32_t face) {
    return face >= 0 && labels.label[complex.cell(face, layer)] != 0;
  };
  for (const CellComplex::Edge& edge : complex.edges) {
    const bool wall = empty(edge.left) != empty(edge.right);
    svg.line(complex.vertices[edge.v0], complex.vertices[edge.v1], wall ? kWallEdge : kThinEdge,
             wall ? 2 : 0.4);
  }
  char title[100];
  std::snprintf(title, sizeof title, "Cells of layer %zu: %.2f m to %.2f m", layer, complex.levels[layer],
                complex.levels[layer + 1]);
  return {"graphcut", "cells_" + std::to_string(layer) + ".svg", title,
          "Blue: empty, darker where the decision is surer. Grey: solid or outside. Pink: empty but hardly "
          "observed. Black: walls.",
          svg.str()};
}

}  // namespace roomcut

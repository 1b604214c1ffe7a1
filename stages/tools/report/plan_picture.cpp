// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/plan_picture.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "common/geometry/scan_coordinates.h"

namespace roomcut::report {

namespace {

constexpr Colour kWallEdge{20, 20, 20}, kThinEdge{190, 190, 190};
constexpr double kMostScale = 60, kWidth_px = 1000;

}  // namespace

Svg plan_of(const CellComplex& complex) {
  Vec2 low(1e30, 1e30), high(-1e30, -1e30);
  for (const Vec2& vertex : complex.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return {low, high, std::min(kMostScale, kWidth_px / (high - low).maxCoeff())};
}

void fill_cells(Svg& svg, const CellComplex& complex, std::size_t layer,
                const std::function<CellLook(std::size_t cell)>& look) {
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    const FaceCorners corners = complex.corners(f);
    const CellLook cell = look(complex.cell(f, layer));
    svg.polygon(std::vector<Vec2>(corners.begin(), corners.end()), cell.fill, 1, cell.title);
  }
}

void draw_edges(Svg& svg, const CellComplex& complex, const Labels* labels, std::size_t layer) {
  const auto empty = [&](std::int32_t face) {
    return labels != nullptr && is_empty(complex, labels->label, face, layer);
  };
  for (const CellComplex::Edge& edge : complex.edges) {
    const bool wall = empty(edge.left) != empty(edge.right);
    svg.line(complex.vertices[edge.v0], complex.vertices[edge.v1], wall ? kWallEdge : kThinEdge,
             wall ? 2 : 0.4);
  }
}

std::string heights_of(const CellComplex& complex, std::size_t layer) {
  char text[80];
  const ScanCoordinates scan(complex.frame);
  std::snprintf(text, sizeof text, "%.2f m to %.2f m", scan.caption_height(complex.levels[layer]),
                scan.caption_height(complex.levels[layer + 1]));
  return text;
}

}  // namespace roomcut::report

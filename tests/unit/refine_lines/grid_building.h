// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::testing {

/// A complex of rectangles: between the outermost x and y (the bounding box) every value is a wall line, "x0"
/// … and "y0" …
inline CellComplex grid_complex(const std::vector<double>& xs, const std::vector<double>& ys,
                                const std::vector<double>& levels) {
  CellComplex c;
  c.levels = levels;
  const auto nx = static_cast<int>(xs.size());
  const auto ny = static_cast<int>(ys.size());
  for (const double y : ys) {
    for (const double x : xs) {
      c.vertices.emplace_back(x, y);
    }
  }
  std::vector<int> line_x(xs.size(), -1);
  std::vector<int> line_y(ys.size(), -1);
  for (int i = 1; i + 1 < nx; ++i) {
    line_x[i] = static_cast<int>(c.lines.size());
    c.lines.push_back({"x" + std::to_string(i), {0, xs[i]}, ys.front(), ys.back(), {}});
  }
  for (int j = 1; j + 1 < ny; ++j) {
    line_y[j] = static_cast<int>(c.lines.size());
    c.lines.push_back({"y" + std::to_string(j), {std::numbers::pi / 2, ys[j]}, -xs.back(), -xs.front(), {}});
  }
  const auto face = [&](int i, int j) {
    return i < 0 || j < 0 || i >= nx - 1 || j >= ny - 1 ? -1 : j * (nx - 1) + i;
  };
  const auto vertex = [&](int i, int j) { return j * nx + i; };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i + 1 < nx; ++i) {
      c.edges.push_back({vertex(i, j), vertex(i + 1, j), face(i, j), face(i, j - 1), line_y[j]});
    }
  }
  for (int j = 0; j + 1 < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      c.edges.push_back({vertex(i, j), vertex(i, j + 1), face(i - 1, j), face(i, j), line_x[i]});
    }
  }
  const int rows = ny * (nx - 1);
  c.face_offset.push_back(0);
  for (int j = 0; j + 1 < ny; ++j) {
    for (int i = 0; i + 1 < nx; ++i) {
      const int corners[4] = {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
      const int sides[4] = {j * (nx - 1) + i, rows + j * nx + i + 1, (j + 1) * (nx - 1) + i,
                            rows + j * nx + i};
      c.face_vertex.insert(c.face_vertex.end(), corners, corners + 4);
      c.face_edge.insert(c.face_edge.end(), sides, sides + 4);
      c.face_offset.push_back(c.face_offset.back() + 4);
    }
  }
  return c;
}

/// Labels by the centroid of each cell's plan face.
inline std::vector<std::uint8_t> labelled(const CellComplex& c,
                                          const std::function<bool(const Vec2&, std::size_t)>& empty) {
  std::vector<std::uint8_t> label(c.cells(), 0);
  for (std::size_t k = 0; k < c.layers(); ++k) {
    for (std::size_t f = 0; f < c.faces(); ++f) {
      const Vec2 middle = 0.5 * (c.corners(f)[0] + c.corners(f)[2]);
      label[c.cell(f, k)] = empty(middle, k) ? Label::kEmpty : Label::kSolid;
    }
  }
  return label;
}

}  // namespace roomcut::testing

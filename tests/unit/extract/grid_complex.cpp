// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/extract/grid_complex.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace roomcut::test {

CellComplex grid_complex(const std::vector<double>& x, const std::vector<double>& y,
                         const std::vector<double>& levels, double angle,
                         const std::function<bool(int, int)>& joined) {
  const int nx = static_cast<int>(x.size());
  const int ny = static_cast<int>(y.size());
  CellComplex out;
  out.levels = levels;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      out.vertices.emplace_back(std::cos(angle) * x[i] - std::sin(angle) * y[j],
                                std::sin(angle) * x[i] + std::cos(angle) * y[j]);
    }
  }
  const auto vertex = [nx](int i, int j) { return j * nx + i; };
  const auto add_line = [&out](int a, int b) {
    CellComplex::Line line;
    line.line =
        line_through(out.vertices[static_cast<std::size_t>(a)], out.vertices[static_cast<std::size_t>(b)]);
    line.wall_id = "w" + std::to_string(out.lines.size());
    line.t0 = -100;
    line.t1 = 100;
    out.lines.push_back(line);
  };
  // Lines 0 … nx - 3 are x_1 …, after them y_1 …
  for (int i = 1; i + 1 < nx; ++i) {
    add_line(vertex(i, 0), vertex(i, ny - 1));
  }
  for (int j = 1; j + 1 < ny; ++j) {
    add_line(vertex(0, j), vertex(nx - 1, j));
  }
  const auto line_of = [&](int a, int b) {
    const bool upright = a % nx == b % nx;
    const int k = upright ? a % nx : a / nx;
    const int last = (upright ? nx : ny) - 1;
    return k == 0 || k == last ? -1 : k - 1 + (upright ? 0 : nx - 2);
  };
  std::map<std::pair<int, int>, std::int32_t> edge_of;
  out.face_offset = {0};
  const auto add_face = [&](const std::vector<int>& corners) {
    const auto face = static_cast<std::int32_t>(out.faces());
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const int a = corners[c];
      const int b = corners[(c + 1) % corners.size()];
      const auto [found, fresh] =
          edge_of.insert({std::minmax(a, b), static_cast<std::int32_t>(out.edges.size())});
      if (fresh) {
        out.edges.push_back({std::min(a, b), std::max(a, b), -1, -1, line_of(a, b)});
      }
      CellComplex::Edge& edge = out.edges[static_cast<std::size_t>(found->second)];
      (edge.v0 == a ? edge.left : edge.right) = face;
      out.face_vertex.push_back(a);
      out.face_edge.push_back(found->second);
    }
    out.face_offset.push_back(static_cast<std::int64_t>(out.face_vertex.size()));
  };
  for (int j = 0; j + 1 < ny; ++j) {
    for (int i = 0; i + 1 < nx; ++i) {
      const int end = joined && i + 2 < nx && joined(i, j) ? i + 2 : i + 1;
      std::vector<int> corners;
      for (int k = i; k <= end; ++k) corners.push_back(vertex(k, j));
      for (int k = end; k >= i; --k) corners.push_back(vertex(k, j + 1));
      add_face(corners);
      i = end - 1;
    }
  }
  return out;
}

Labels label_where(const CellComplex& complex, const std::function<bool(const Vec2&, double)>& empty) {
  Labels labels;
  for (std::size_t k = 0; k < complex.layers(); ++k) {
    for (std::size_t f = 0; f < complex.faces(); ++f) {
      const double z = 0.5 * (complex.levels[k] + complex.levels[k + 1]);
      labels.label.push_back(empty(complex.centroid(f), z) ? 1 : 0);
    }
  }
  labels.margin_m3.assign(complex.cells(), 0);
  labels.unobserved.assign(complex.cells(), 0);
  return labels;
}

}  // namespace roomcut::test

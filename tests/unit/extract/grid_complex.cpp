// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/extract/grid_complex.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace roomcut::test {

namespace {

class GridMaker {
 public:
  GridMaker(const std::vector<double>& x, const std::vector<double>& y, double angle)
      : nx_(static_cast<int>(x.size())), ny_(static_cast<int>(y.size())) {
    for (const double yj : y) {
      for (const double xi : x) {
        out_.vertices.emplace_back(std::cos(angle) * xi - std::sin(angle) * yj,
                                   std::sin(angle) * xi + std::cos(angle) * yj);
      }
    }
    for (int i = 1; i + 1 < nx_; ++i) add_line(vertex(i, 0), vertex(i, ny_ - 1));
    for (int j = 1; j + 1 < ny_; ++j) add_line(vertex(0, j), vertex(nx_ - 1, j));
    out_.face_offset = {0};
  }

  // The grid cells (i, j) … (end - 1, j) as one face.
  void add_face(int i, int end, int j) {
    std::vector<int> corners;
    for (int k = i; k <= end; ++k) corners.push_back(vertex(k, j));
    for (int k = end; k >= i; --k) corners.push_back(vertex(k, j + 1));
    for (std::size_t c = 0; c < corners.size(); ++c) {
      out_.face_vertex.push_back(corners[c]);
      out_.face_edge.push_back(edge(corners[c], corners[(c + 1) % corners.size()]));
    }
    out_.face_offset.push_back(static_cast<std::int64_t>(out_.face_vertex.size()));
  }

  CellComplex take() { return std::move(out_); }

 private:
  int vertex(int i, int j) const { return j * nx_ + i; }

  void add_line(int a, int b) {
    CellComplex::Line line;
    line.wall_id = "w" + std::to_string(out_.lines.size());
    line.line =
        line_through(out_.vertices[static_cast<std::size_t>(a)], out_.vertices[static_cast<std::size_t>(b)]);
    line.t0 = -100;
    line.t1 = 100;
    out_.lines.push_back(line);
  }

  // Lines 0 … nx - 3 are x_1 …, after them y_1 …; -1 on the bounding box.
  int line_of(int a, int b) const {
    const bool upright = a % nx_ == b % nx_;
    const int k = upright ? a % nx_ : a / nx_;
    const int last = (upright ? nx_ : ny_) - 1;
    return k == 0 || k == last ? -1 : k - 1 + (upright ? 0 : nx_ - 2);
  }

  // The edge a -> b of the face that is being added, on its left.
  std::int32_t edge(int a, int b) {
    const auto next = static_cast<std::int32_t>(out_.edges.size());
    const auto [found, fresh] = edge_of_.insert({std::pair(std::min(a, b), std::max(a, b)), next});
    if (fresh) out_.edges.push_back({std::min(a, b), std::max(a, b), -1, -1, line_of(a, b)});
    CellComplex::Edge& made = out_.edges[static_cast<std::size_t>(found->second)];
    (made.v0 == a ? made.left : made.right) = static_cast<std::int32_t>(out_.faces());
    return found->second;
  }

  int nx_, ny_;
  CellComplex out_;
  std::map<std::pair<int, int>, std::int32_t> edge_of_;
};

}  // namespace

CellComplex grid_complex(const std::vector<double>& x, const std::vector<double>& y,
                         const std::vector<double>& levels, double angle,
                         const std::function<bool(int, int)>& joined) {
  GridMaker maker(x, y, angle);
  const int cells = static_cast<int>(x.size()) - 1;
  for (int j = 0; j + 1 < static_cast<int>(y.size()); ++j) {
    for (int i = 0; i < cells;) {
      const int end = joined && i + 1 < cells && joined(i, j) ? i + 2 : i + 1;
      maker.add_face(i, end, j);
      i = end;
    }
  }
  CellComplex out = maker.take();
  out.levels = levels;
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

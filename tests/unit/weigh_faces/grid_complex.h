// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::weigh_faces {

/// A cell complex whose plan is a grid: lines x = xs[1 … n-2] and y = ys[1 … n-2] inside the box xs, ys, the
/// whole plan turned by `turn` about the origin. Face (i, j) between xs[i], xs[i+1] and ys[j], ys[j+1] has
/// index j * (nx - 1) + i.
inline CellComplex grid_complex(const std::vector<double>& xs, const std::vector<double>& ys,
                                const std::vector<double>& levels, double turn = 0) {
  CellComplex c;
  c.levels = levels;
  const int nx = static_cast<int>(xs.size());
  const int ny = static_cast<int>(ys.size());
  const auto turned = [turn](double x, double y) {
    return Vec2(std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y);
  };
  const auto vertex = [nx](int i, int j) { return j * nx + i; };
  const auto face = [nx, ny](int i, int j) {
    return i < 0 || j < 0 || i >= nx - 1 || j >= ny - 1 ? -1 : j * (nx - 1) + i;
  };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      c.vertices.push_back(turned(xs[static_cast<std::size_t>(i)], ys[static_cast<std::size_t>(j)]));
    }
  }
  const auto add_line = [&](const Vec2& a, const Vec2& b) {
    const Line2 line = line_through(a, b);
    const double ta = line.along(a);
    const double tb = line.along(b);
    c.lines.push_back({"w" + std::to_string(c.lines.size()), line, std::min(ta, tb), std::max(ta, tb), {}});
    return static_cast<std::int32_t>(c.lines.size() - 1);
  };
  std::vector<std::int32_t> upright(static_cast<std::size_t>(nx), -1);  // line of x = xs[i]
  std::vector<std::int32_t> level(static_cast<std::size_t>(ny), -1);
  for (int i = 1; i + 1 < nx; ++i) {
    upright[static_cast<std::size_t>(i)] = add_line(turned(xs[static_cast<std::size_t>(i)], ys.front()),
                                                    turned(xs[static_cast<std::size_t>(i)], ys.back()));
  }
  for (int j = 1; j + 1 < ny; ++j) {
    level[static_cast<std::size_t>(j)] = add_line(turned(xs.front(), ys[static_cast<std::size_t>(j)]),
                                                  turned(xs.back(), ys[static_cast<std::size_t>(j)]));
  }
  std::vector<std::int32_t> east(static_cast<std::size_t>(nx * ny), -1);   // edge (i, j) -> (i + 1, j)
  std::vector<std::int32_t> north(static_cast<std::size_t>(nx * ny), -1);  // edge (i, j) -> (i, j + 1)
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      if (i + 1 < nx) {
        east[static_cast<std::size_t>(vertex(i, j))] = static_cast<std::int32_t>(c.edges.size());
        c.edges.push_back(
            {vertex(i, j), vertex(i + 1, j), face(i, j), face(i, j - 1), level[static_cast<std::size_t>(j)]});
      }
      if (j + 1 < ny) {
        north[static_cast<std::size_t>(vertex(i, j))] = static_cast<std::int32_t>(c.edges.size());
        c.edges.push_back({vertex(i, j), vertex(i, j + 1), face(i - 1, j), face(i, j),
                           upright[static_cast<std::size_t>(i)]});
      }
    }
  }
  c.face_offset.push_back(0);
  for (int j = 0; j + 1 < ny; ++j) {
    for (int i = 0; i + 1 < nx; ++i) {
      for (const auto& [v, e] :
           {std::pair{vertex(i, j), east[static_cast<std::size_t>(vertex(i, j))]},
            std::pair{vertex(i + 1, j), north[static_cast<std::size_t>(vertex(i + 1, j))]},
            std::pair{vertex(i + 1, j + 1), east[static_cast<std::size_t>(vertex(i, j + 1))]},
            std::pair{vertex(i, j + 1), north[static_cast<std::size_t>(vertex(i, j))]}}) {
        c.face_vertex.push_back(v);
        c.face_edge.push_back(e);
      }
      c.face_offset.push_back(static_cast<std::int64_t>(c.face_vertex.size()));
    }
  }
  return c;
}

/// The edge between two vertices of the grid, by its middle (before turning).
inline std::size_t edge_near(const CellComplex& c, const Vec2& middle) {
  std::size_t best = 0;
  double best_distance = 1e9;
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    const Vec2 m = 0.5 * (c.vertices[static_cast<std::size_t>(c.edges[e].v0)] +
                          c.vertices[static_cast<std::size_t>(c.edges[e].v1)]);
    if ((m - middle).norm() < best_distance) {
      best_distance = (m - middle).norm();
      best = e;
    }
  }
  return best;
}

}  // namespace roomcut::weigh_faces

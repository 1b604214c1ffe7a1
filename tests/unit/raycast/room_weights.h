// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/cell_complex.h"

namespace roomcut {

inline FaceWeights no_weights(const CellComplex& c) {
  FaceWeights w;
  const std::size_t walls = c.edges.size() * c.layers();
  const std::size_t flats = c.faces() * c.levels.size();
  w.wall_omega.assign(walls, 0);
  w.wall_left.assign(walls, 0);
  w.wall_right.assign(walls, 0);
  w.wall_points.assign(walls, 0);
  w.level_omega.assign(flats, 0);
  w.level_floor.assign(flats, 0);
  w.level_ceiling.assign(flats, 0);
  w.level_points.assign(flats, 0);
  w.cell_points.assign(c.cells(), 0);
  w.cell_slope.assign(c.cells(), 0);
  return w;
}

/// Covers the boundary of a set of rooms perfectly: every face between an empty and a solid cell, seen from
/// the empty one.
inline FaceWeights weights_of(const CellComplex& c, const std::vector<bool>& empty) {
  FaceWeights w = no_weights(c);
  for (std::size_t k = 0; k < c.layers(); ++k) {
    for (std::size_t e = 0; e < c.edges.size(); ++e) {
      const CellComplex::Edge& edge = c.edges[e];
      const bool left = edge.left >= 0 && empty[c.cell(static_cast<std::size_t>(edge.left), k)];
      const bool right = edge.right >= 0 && empty[c.cell(static_cast<std::size_t>(edge.right), k)];
      if (left != right) {
        w.wall_omega[c.wall_face(e, k)] = 1;
        w.wall_left[c.wall_face(e, k)] = left ? 1 : 0;
        w.wall_right[c.wall_face(e, k)] = right ? 1 : 0;
      }
    }
  }
  for (std::size_t l = 0; l < c.levels.size(); ++l) {
    for (std::size_t f = 0; f < c.faces(); ++f) {
      const bool above = l < c.layers() && empty[c.cell(f, l)];
      const bool below = l > 0 && empty[c.cell(f, l - 1)];
      if (above != below) {
        w.level_omega[c.level_face(f, l)] = 1;
        w.level_floor[c.level_face(f, l)] = above ? 1 : 0;
        w.level_ceiling[c.level_face(f, l)] = below ? 1 : 0;
      }
    }
  }
  return w;
}

}  // namespace roomcut

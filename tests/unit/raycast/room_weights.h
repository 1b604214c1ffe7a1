// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/interfaces.h"

namespace roomcut::raycast {

/// The values of a feature that is there.
inline const std::vector<float>& feature(const DataTerms& terms, const std::string& name) {
  return std::find_if(terms.features.begin(), terms.features.end(),
                      [&](const CellFeature& f) { return f.name == name; })
      ->value;
}

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
  const auto is_empty = [&](std::int64_t cell) { return cell >= 0 && empty[static_cast<std::size_t>(cell)]; };
  for_each_interface(c, [&](const Interface& face) {
    if (is_empty(face.a) == is_empty(face.b)) {
      return;
    }
    (face.wall ? w.wall_omega : w.level_omega)[face.index] = 1;
    (face.wall ? w.wall_left : w.level_ceiling)[face.index] = is_empty(face.a) ? 1 : 0;
    (face.wall ? w.wall_right : w.level_floor)[face.index] = is_empty(face.b) ? 1 : 0;
  });
  return w;
}

}  // namespace roomcut::raycast

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "common/cells/interfaces.h"

namespace roomcut {

/// The connected pieces of some cells.
struct CellPieces {
  std::vector<std::int32_t> of_cell;  ///< per cell; -1 = not one of those cells
  std::int32_t count = 0;
};

/// Pieces of the cells for which member(cell) holds, connected through faces (not edges) for which
/// joined(Interface) holds. Numbered from 0 by their first cell.
template <class Member, class Joined>
CellPieces connected_pieces(const CellComplex& complex, Member&& member, Joined&& joined) {
  std::vector<std::size_t> parent(complex.cells());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t cell) {
    while (parent[cell] != cell) {
      parent[cell] = parent[parent[cell]];
      cell = parent[cell];
    }
    return cell;
  };
  for_each_interface(complex, [&](const Interface& face) {
    if (face.a < 0 || face.b < 0) {
      return;
    }
    const auto a = static_cast<std::size_t>(face.a);
    const auto b = static_cast<std::size_t>(face.b);
    if (member(a) && member(b) && joined(face)) {
      const std::size_t of_a = root(a);
      const std::size_t of_b = root(b);
      parent[std::max(of_a, of_b)] = std::min(of_a, of_b);  // the first cell of a piece is its root
    }
  });
  CellPieces pieces;
  pieces.of_cell.assign(complex.cells(), -1);
  for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
    if (member(cell)) {
      const std::size_t first = root(cell);
      pieces.of_cell[cell] = first == cell ? pieces.count++ : pieces.of_cell[first];
    }
  }
  return pieces;
}

}  // namespace roomcut

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace roomcut {

/// Points in one cell of the window: a cube with the edge of a tile.
struct CellCount {
  std::uint32_t tile = 0;   ///< row-major index in the window
  std::uint32_t layer = 0;  ///< tile edges above the window's lower side
  std::uint64_t points = 0;
};

/// One kept tile: which of its layers hold points of the building, and how many points those are.
struct KeptTile {
  std::uint32_t tile = 0;
  std::uint64_t layers = 0;  ///< bit i: layer i is kept
  std::uint64_t points = 0;
};

/// Tells the building from ghosts: far, sparse cells, as mirrors, glass and the sky put them hundreds of
/// metres away. A cell is well filled when it holds at least 1 % of the points of a typical cell (the one
/// with the median point). Well-filled cells less than two cells apart hang together; such a group is kept
/// when it has at least 1 % of the points of the largest. Other cells are kept when they touch a kept one.
/// Sorted by tile, i.e. by (iy, ix).
std::vector<KeptTile> without_ghosts(std::vector<CellCount> cells);

}  // namespace roomcut

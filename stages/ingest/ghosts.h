// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace roomcut::ingest {

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
  std::uint64_t repeated = 0;  ///< further points in the store that are left out (leave_out_duplicates())
};

/// Where a scan goes on behind what is kept, with too few points to show anything.
struct ThinEnd {
  std::uint64_t points = 0;
  int cells = 0;  ///< how far it goes on, in tile edges
};

struct KeptCells {
  std::vector<KeptTile> tiles;  ///< by tile, i.e. by (iy, ix)
  ThinEnd thin;                 ///< not kept
};

/// Tells the building from ghosts: far, sparse cells, as mirrors, glass and the sky put them hundreds of
/// metres away. A cell is well filled when it holds at least 1 % of the points of a typical cell (the one
/// with the median point), or the share that the beams of one scanner have so far from the next dense cell
/// (1/2 % over the third power of the distance in cells) and, with such cells beside it in a block of 2 x 2 x
/// 2, 30 points. Well-filled cells less than two cells apart hang together; such a group is kept when it has
/// at least 1 % of the points of the largest, or in eight cells half as many as a typical cell: a gatehouse
/// as dense as the hall is a building. Other cells are kept when they touch a kept one.
KeptCells without_ghosts(const std::vector<CellCount>& counts);

/// The same without any doubt: every cell is kept.
KeptCells all_cells(const std::vector<CellCount>& counts);

}  // namespace roomcut::ingest

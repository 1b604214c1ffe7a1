// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace roomcut::ingest {

/// Which of the 27 voxels of a neighbourhood hold points: bit 3·column + (0, 1, 2 upwards), columns
/// row-major.
using VoxelMask = std::uint32_t;

/// The mask seen along axis 0, 1, 2 (x, y, z): 9 bits, one per line of three voxels.
unsigned projected(VoxelMask mask, int axis);

/// How many of the 9 cells of a plane's neighbourhood the surface covers, from `points` in `filled` cells.
/// All 9 when the empty ones are no more than chance leaves empty (each cell empty with probability
/// exp(-points/9)).
struct Covered {
  double cells = 9;
  bool whole = true;
};
Covered covered_cells(std::uint32_t points, int filled);

/// Length of the line with unit normal (nx, ny) at distance `d` from the centre of a square of edge 3 that
/// lies in the square; 3 for a line along the axes through the centre. At least 1.
double chord_of_square(double nx, double ny, double d);

}  // namespace roomcut::ingest

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/cell_pieces.h"
#include "stages/extract/columns.h"
#include "stages/extract/storeys.h"

namespace roomcut::extract {

/// What is known of a space: a room, or all rooms of a storey together. Local metres.
struct Space {
  int storey = 0;
  double floor_z = 0;    ///< height of the largest part of the floor, at its middle [m]
  double ceiling_z = 0;  ///< height of the largest part of the ceiling, at its middle [m]
  double lowest_ceiling_z = 0, highest_ceiling_z = 0;  ///< of all parts [m]
  double area_m2 = 0;                                  ///< of its plan
  double volume_m3 = 0;
  double unobserved_m3 = 0;  ///< volume of its cells with too little evidence (Labels::unobserved)
  Vec2 centre{0, 0};         ///< of its plan's area; may lie outside an L
  double height() const { return area_m2 > 0 ? volume_m3 / area_m2 : 0; }  ///< mean clear height [m]
};

/// What the pieces measure, whose storeys are not set yet.
std::vector<Space> measure_pieces(const EndHeights& heights, const Labels& labels, const CellPieces& pieces);

struct Rooms {
  std::vector<Space> spaces;          ///< by storey, then by volume, largest first
  std::vector<std::int32_t> of_cell;  ///< index into spaces; -1 = solid
};

/// The connected pieces of empty space within a storey (through faces, not edges). On labels in which doors
/// are still closed rooms stay apart; rooms joined by a gap of the walls themselves are one piece.
Rooms find_rooms(const EndHeights& heights, const Labels& labels, const Storeys& storeys);

/// Each storey as a whole.
std::vector<Space> measure_storeys(const EndHeights& heights, const Labels& labels, const Storeys& storeys);

}  // namespace roomcut::extract

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/extract/rooms.h"

namespace roomcut::extract {

/// A room beside an unknown space, and how much wall they share [m^2].
struct SharedWall {
  std::int32_t room = 0;
  double area_m2 = 0;
};

/// A connected space that graphcut labelled unknown: where it is and why. Local metres.
struct UnknownSpace {
  Space measures;
  double seen_inside = 0;  ///< mean share of what lies around it that was seen from inside, 0 … 1
  double closed = 0;       ///< mean share of the directions all around in which something stands, 0 … 1
  double probability = 0;  ///< mean probability of being empty, 0 … 1
  Vec2 place{0, 0};        ///< well inside: where a scanner would tell
  std::vector<SharedWall> beside;  ///< longest wall first
  /// Whether something stands nearly all around: rather a room that nobody entered than open air.
  bool is_closed() const;
};

struct UnknownSpaces {
  std::vector<UnknownSpace> spaces;   ///< by storey, then by volume, largest first
  std::vector<std::int32_t> of_cell;  ///< index into spaces; -1 = none
};

/// The unknown cells in pieces, parted where a wall or a slab was likely seen. `rooms` of the same complex,
/// `storeys` ascending. Deterministic.
UnknownSpaces find_unknown_spaces(const CellComplex& complex, const Labels& labels,
                                  const FaceWeights& weights, const DataTerms& terms, const CellRooms& rooms,
                                  const std::vector<Space>& storeys, const StoreyParams& params);

}  // namespace roomcut::extract

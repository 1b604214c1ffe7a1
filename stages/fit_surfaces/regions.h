// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/fit_surfaces/observe.h"
#include "stages/fit_surfaces/plane_fit.h"
#include "stages/fit_surfaces/seats.h"

namespace roomcut::fit_surfaces {

/// Level faces that are one floor or ceiling.
struct Region {
  std::int32_t level = 0;   ///< of the first of its faces
  std::int32_t plane = -1;  ///< of the complex, which it follows; -1 = none
  bool ceiling = false;
  std::vector<std::size_t> faces;  ///< level faces, ascending
};

/// Which seat each level face of the surface has: that with the most points; without points, as its
/// neighbours on the same level and side. Per level face an index into `seats`, size() where it is none.
std::vector<std::size_t> choose_seats(const CellComplex& complex, const Seats& seats,
                                      const std::vector<Observation>& observations);

/// The regions of chosen seats: level faces of one level and side that meet along edges of the plan, and all
/// faces of a sloped plane. Sorted by level, then by first face; planes last.
std::vector<Region> find_regions(const CellComplex& complex, const Seats& seats,
                                 const std::vector<std::size_t>& chosen);

}  // namespace roomcut::fit_surfaces

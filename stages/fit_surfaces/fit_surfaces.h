// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/level_surfaces.h"
#include "common/cloud/cloud.h"
#include "stages/fit_surfaces/observe.h"
#include "stages/fit_surfaces/params.h"
#include "stages/fit_surfaces/plane_fit.h"
#include "stages/fit_surfaces/seats.h"

namespace roomcut::fit_surfaces {

/// The result, and what it is worth.
struct FittedSurfaces {
  LevelSurfaces surfaces;
  std::size_t regions = 0;  ///< floors and ceilings of one level each, split ones counted apart
  std::size_t tilted = 0;   ///< of them follow a tilted plane
  std::size_t split = 0;    ///< parts beyond the first of regions with several heights
  std::size_t unseen = 0;   ///< too little seen: they keep their level
  double largest_shift_m = 0,
         median_shift_m = 0;  ///< between level and height at the middle, weighted by area
  Roughness roughness;
  double largest_rms_m = 0;  ///< of patches about their surface, among those of 2 m² and more
};

/// Gives every floor and ceiling of a labelling its own height or plane (see README.md), by one pass over the
/// points. Same points, same result, in any order and with any number of threads.
class SurfaceFitter {
 public:
  /// `complex` must outlive the fitter. `label` per cell. Only the noise of `cloud` is used.
  SurfaceFitter(const CellComplex& complex, const std::vector<std::uint8_t>& label, const CloudHeader& cloud,
                const FitSurfacesParams& params);

  double reach_m() const { return reach_m_; }
  /// Takes in the points of a tile. Thread-safe.
  void add(const CloudTile& tile) { observer_.add(tile); }
  std::uint64_t points() const { return observer_.points(); }
  /// After all points are in. `held` per sloped plane of the complex: 1 = it stays as it is (none = all are
  /// fitted).
  FittedSurfaces fit(const std::vector<std::uint8_t>& held = {}) const;

 private:
  const CellComplex& complex_;
  FitSurfacesParams params_;
  double reach_m_;
  Seats seats_;
  SurfaceObserver observer_;
};

}  // namespace roomcut::fit_surfaces

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::weigh_faces {

/// Shares of a wall face's length along which floor and ceiling reach it from its left and its right, 0 … 1.
struct StripShares {
  double left = 0, right = 0;
};

/// The face of the plan beside an edge: behind lines that are nearly equal (3 cm), up to `beside_m` off as
/// far as no wall was seen on the way (the other face of a thin wall), and further, up to 10 cm, as long as
/// lines that carry nothing in the layer cut slivers off.
class FacesBeside {
 public:
  FacesBeside(const CellComplex& complex, std::size_t edge, bool left, double beside_m);
  /// -1 = beyond the bounding box. Needs wall_omega.
  std::int32_t face(const CellComplex& complex, const FaceWeights& weights, std::size_t layer) const;

 private:
  struct Step {
    std::size_t edge;   // that is crossed
    std::int32_t face;  // behind it
    bool within;        // beside_m
  };
  std::int32_t nearest_;
  std::vector<Step> beyond_;
};

/// Probability that the empty side of a wall face is its left one. A wall stands where a floor and a ceiling
/// end. The evidence: the faces of the plan on both sides (slivers between nearly equal lines have no floor
/// of their own) at the nearest levels below and above; as far as these are uncovered and the wall goes on,
/// those at the next levels too; and the strips right beside the wall. Needs wall_omega, level_floor and
/// level_ceiling. No evidence: 1/2.
double left_probability(const CellComplex& complex, const FaceWeights& weights, std::size_t edge,
                        std::size_t layer, const StripShares& strips, const FacesBeside& left,
                        const FacesBeside& right);

}  // namespace roomcut::weigh_faces

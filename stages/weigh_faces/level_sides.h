// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::weigh_faces {

/// Evidence for the empty side of a level face, from the points beside it, in bins.
struct LevelSides {
  double over = 0, under = 0;  ///< bins with points a hand above, below: walls' feet, furniture, lamps
  double open_over = 0,
         open_under = 0;  ///< bins with a tall gap on this side and a slab or nothing on the other

  LevelSides& operator+=(const LevelSides& other) {
    over += other.over;
    under += other.under;
    open_over += other.open_over;
    open_under += other.open_under;
    return *this;
  }
};

/// For each face of the plan, the probability that the surface on `level` is a floor, empty above. Faces that
/// no wall separates share their evidence; the rest of the level is the prior. A face with much evidence of
/// its own may differ. Needs wall_omega and level_omega. The lowest level is all floor, the highest all
/// ceiling. No evidence: 1/2.
std::vector<double> floor_probability(const CellComplex& complex, const FaceWeights& weights,
                                      std::size_t level, const std::vector<LevelSides>& sides);

}  // namespace roomcut::weigh_faces

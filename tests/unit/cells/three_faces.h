// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cells/cell_complex.h"

namespace roomcut {

/// The smallest complex with a vertex in the middle of a side, by hand. Box 4 x 2 m; x = 1 cuts all of it, y
/// = 1 only what is right of it. Face 0 is left, 1 right below, 2 right above. Levels 0, 2.5, 3 m.
///   6---5-------4
///   | 0 | 2     |
///   |   7-------3      vertex numbers
///   |   | 1     |
///   0---1-------2
CellComplex three_faces();

}  // namespace roomcut
